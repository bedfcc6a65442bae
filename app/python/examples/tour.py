"""A tour of the module in cells, like a notebook: python3 tour.py, or open it in an editor that supports # %%.

It forms a shell, prints its numbers, pushes it forward and back, searches for another state, and compares
meshes. This takes some seconds.
"""
# %% Form a shell: eight rods per direction, drawn in to three quarters of its radius
import numpy as np

import gridshell as gs

preset = {"footprint": {"rods": 8, "longest_leg": 1.5}, "actuation": {"ratio": 0.75},
          "accuracy": {"tolerance": 1e-2}}
shell = gs.Session("s1_actuation", preset)
shell.actuate()
print(f"{shell.height_mm:.2f} mm high, {shell.energy_mJ:.2f} mJ, {shell.certificate}")

# %% The layout of the shell: joints by their indices, cells by their joints
layout = shell.layout
index = {tuple(joint): k for k, joint in enumerate(layout.joints)}
print(f"{len(index)} joints, {len(layout.cells)} complete cells, {len(layout.rods)} rods")
print("joint (0, 0) is at", shell.nodes[index[0, 0]].round(2), "mm")
print(f"K of the cells from {shell.cell_K.min():.3f} to {shell.cell_K.max():.3f}, in all {shell.total_K:.3f} rad")

# %% Its path: a state does not change when the session continues, so states can be collected
path = gs.Session("s1_actuation", preset)
states = []
for progress in np.linspace(0.2, 1, 5):
    path.actuate(progress)
    states.append(path.state)
for state in states:
    print(f"R_a = {state.boundary_radius_mm:6.2f} mm: {state.height_mm:6.2f} mm high, {state.energies['bend']:6.2f} mJ")

# %% Push a joint 6 mm inward and back, along a fixed direction, and print the force and its error
shell.push((0, 0), depth_mm=2)
along = np.array(shell.directions[0])
start = shell.nodes[index[0, 0]] - 2 * along
for depth in (2, 4, 6, 4, 2):
    shell.push((0, 0), to_mm=start + depth * along, along=along)
    print(f"{shell.depth_mm:.1f} mm: {shell.force_N:.5f} ± {shell.state.push_error_N:.0e} N")
shell.release((0, 0))

# %% Search for another state: apply random forces and remove them, then return to a checkpoint. A step that
# fails raises an exception, and the shell remains in its last certified state.
saved = shell.save()
before = shell.energy_mJ
for seed in range(1, 4):
    try:
        shell.jitter(seed=seed, force_N=0.8)
    except gs.NoEquilibrium as error:
        print(f"seed {seed}: {error}")
    print(f"seed {seed}: {shell.energy_mJ - before:+.3f} mJ, {shell.height_mm:.2f} mm high")
    shell.restore(saved)

# %% Check the accuracy: with twice the edges on a single mesh, the difference falls to a quarter
heights = []
for edges in (4, 8, 16):
    one = gs.Session("s1_actuation", preset | {"accuracy": {"edges_per_segment": edges}})
    one.actuate()
    heights.append(one.height_mm)
coarse, fine = np.diff(heights)
print(f"heights {np.round(heights, 3)} mm, differences {coarse:.4f} and {fine:.4f} mm")
