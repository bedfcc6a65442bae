"""Fits the radius of the actuated boundary to measured joints, by Gauss-Newton.

Derivatives are central differences: a state depends smoothly on the numbers of its preset, and its
error is nearly equal on both sides, so that a step of 0.01 mm gives five digits or more.
"""
import numpy as np

import gridshell as gs


def joints(radius_mm):
    """Coordinates of the joints of the formed shell, as one vector, mm."""
    shell = gs.Session("s1_actuation", {
        "footprint": {"rods": 8, "radius_mm": 82.0},  # tables in tables, or "footprint.rods": 8
        "actuation.radius_mm": radius_mm,
        "accuracy.edges_per_segment": 8,  # one mesh for all
    })
    shell.actuate(1)
    return shell.nodes[:len(shell.layout.joints)].ravel()


def fit(measured, radius_mm, step_mm=0.01):
    """The radius at which the joints are nearest to the measured ones, by least squares."""
    for _ in range(8):
        slope = (joints(radius_mm + step_mm) - joints(radius_mm - step_mm)) / (2 * step_mm)
        change = slope @ (measured - joints(radius_mm)) / (slope @ slope)
        radius_mm += change
        if abs(change) < 1e-7:
            break
    return radius_mm


if __name__ == "__main__":
    noise = np.random.default_rng(1).normal(0, 0.1, joints(64.3).size)
    print(f"R_a = {fit(joints(64.3), 66):.5f} mm, from joints off by 0.1 mm each: "
          f"{fit(joints(64.3) + noise, 66):.2f} mm")
