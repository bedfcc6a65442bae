"""tests/calculix.py PROGRAM: shells and their loads and frequencies against CalculiX (Debian's
calculix-ccx; left out where it is not installed, exit code 77).

CalculiX forms the same shells by itself. Its beams (B32R) are straight in a plane at first, with
clamped ends. Forces on the joints lift them, their ends are moved inwards, and the forces are removed.
Then a load is applied, and both programs compute the natural frequencies of the loaded shell, with the
stresses in its rods. In both, joints transmit forces but no moments. Shapes, displacements and
frequencies must agree within 1 %.
"""

import csv
import math
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SPACING, DIAMETER, YOUNG, DENSITY = 20.0, 0.8, 83000.0, 6450e-12
# A square section has the rod's EI, EA and mass if modulus and density are multiplied by SHARE. With
# SHEAR, the round rod has the torsional stiffness of the square (Poisson's ratio 0).
SIDE, SHARE = DIAMETER * math.sqrt(3) / 2, math.pi / 3
SHEAR = YOUNG * SHARE / 2 * 0.140577 * SIDE**4 / (math.pi * DIAMETER**4 / 32)
SHELLS = {"two rods per direction": (2, 40.0, 0.95), "three": (3, 50.0, 0.95),
          "three with longer legs": (3, 60.0, 0.96)}
PARTS, LIFT, COUNT = 4, 4.0, 4


def preset(rods, radius, ratio):
    return f"""
[rod]
diameter_mm = {DIAMETER}
young_GPa = {YOUNG / 1000}
shear_GPa = {SHEAR / 1000}
density_kg_m3 = {DENSITY * 1e12}
[footprint]
rods = {rods}
radius_mm = {radius}
{'placement = "on_axis"' if rods % 2 else ''}
[ends]
kind = "clamped"
[actuation]
ratio = {ratio}
[accuracy]
tolerance = 1e-4
[limits]
max_strain = 0.02
[[loads.case]]
name = "push"
points = [[0, 0, 0.0, 0.2, -0.5]]
"""


class Beams:
    """The flat grid; every rod has its own nodes, numbered from 1."""

    def __init__(self, rods, radius):
        lines = [(k - (rods - 1) / 2) * SPACING for k in range(rods)]
        self.places, self.elements, self.ends, self.at = [], ([], []), [], {}
        for family in (0, 1):
            for line in lines:
                half = math.sqrt(radius**2 - line**2)
                stops = [-half] + lines + [half]
                first = len(self.places) + 1
                for a, b in zip(stops, stops[1:]):
                    self.add(family, line, a, a in lines)
                    for m in range(1, 2 * PARTS):
                        self.add(family, line, a + (b - a) * m / (2 * PARTS), False)
                self.add(family, line, half, False)
                last = len(self.places)
                self.elements[family].extend((k, k + 1, k + 2) for k in range(first, last, 2))
                self.ends += [first, last]

    def add(self, family, line, along, joint):
        place = (along, line) if family == 0 else (line, along)
        self.places.append(place)
        if joint:
            self.at.setdefault(place, []).append(len(self.places))

    def deck(self, ratio, heights, loaded):
        lines = ["*NODE,NSET=ALL"]
        lines += [f"{k},{x:.10g},{y:.10g},0." for k, (x, y) in enumerate(self.places, 1)]
        number = 0
        for family in (0, 1):
            lines += [f"*ELEMENT,TYPE=B32R,ELSET=RODS{family}"]
            for a, b, c in self.elements[family]:
                number += 1
                lines += [f"{number},{a},{b},{c}"]
        lines += ["*MATERIAL,NAME=M", "*ELASTIC", f"{YOUNG * SHARE:.9g},0."]
        lines += ["*DENSITY", f"{DENSITY * SHARE:.9g}"]
        for family in (0, 1):
            lines += [f"*BEAM SECTION,ELSET=RODS{family},MATERIAL=M,SECTION=RECT"]
            lines += [f"{SIDE:.10g},{SIDE:.10g}", "0.,0.,1."]
        for nodes in self.at.values():
            for node in nodes[1:]:
                for d in (1, 2, 3):
                    lines += ["*EQUATION", "2", f"{node},{d},1.,{nodes[0]},{d},-1."]
        step = ["*STEP,NLGEOM,INC=400", "*STATIC", "0.1,1."]
        step += ["*CONTROLS,PARAMETERS=TIME INCREMENTATION", "30,40,9,60,10,40,,20,,"]
        told = ["*NODE PRINT,NSET=ALL,FREQUENCY=1000", "U", "*END STEP"]

        # the forces lift the joints to the side to which the shell buckles
        highest = max(map(abs, heights.values()))

        def forces(size):
            return ["*CLOAD"] + [f"{nodes[0]},3,{size * heights[place] / highest:.9g}"
                                 for place, nodes in self.at.items()]

        lines += step + ["*BOUNDARY"] + [f"{k},1,6" for k in self.ends] + forces(LIFT) + told
        lines += step + ["*BOUNDARY"]
        for k in self.ends:
            for d in (0, 1):
                lines += [f"{k},{d + 1},{d + 1},{self.places[k - 1][d] * (ratio - 1):.10g}"]
        lines += told + step + forces(0.0) + told
        lines += step + ["*CLOAD", f"{loaded},2,0.2", f"{loaded},3,-0.5"] + told
        lines += ["*STEP,PERTURBATION", "*FREQUENCY", f"{COUNT}", "*END STEP"]
        return "\n".join(lines) + "\n"


def answers(dat):
    """Displacements of each step, and frequencies."""
    steps, frequencies, modes = [], [], False
    for line in dat.read_text().splitlines():
        words = line.split()
        if "E I G E N V A L U E   O U T P U T" in line:
            modes = True
        elif "P A R T I C I P A T I O N" in line:
            modes = False
        elif "displacements" in line:
            steps.append({})
        elif modes and len(words) == 5 and words[0].isdigit():
            frequencies.append(float(words[3]))
        elif steps and not modes and len(words) == 4 and words[0].isdigit():
            steps[-1][int(words[0])] = [float(x) for x in words[1:]]
    return steps, frequencies


def run(*command, cwd):
    done = subprocess.run([str(word) for word in command], cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}:\n{done.stdout[-600:]}{done.stderr[-600:]}")


def joints_of(run_folder):
    with open(run_folder / "joints.csv") as table:
        return {(float(row["u_mm"]), float(row["v_mm"])):
                    [float(row[key]) for key in ("x_mm", "y_mm", "z_mm")]
                for row in csv.DictReader(table)}


def compare(name, size, program, work):
    (work / "formed.toml").write_text(preset(*size))
    (work / "loaded.toml").write_text(preset(*size) + '[[step]]\ndo = "load"\ncase = "push"\n')
    for which in ("formed", "loaded"):
        run(program, "run", f"{which}.toml", "--frames", "2", "--quiet", "-o", which, cwd=work)
    run(program, "modes", "loaded.toml", "--count", COUNT, "--size", "160x90", "--quiet", "-o",
        "modes", cwd=work)
    formed, loaded = joints_of(work / "formed"), joints_of(work / "loaded")
    rods, radius, ratio = size
    beams = Beams(rods, radius)
    heights = {place: at[2] for place, at in formed.items()}
    shift = 0.0 if rods % 2 else SPACING / 2
    (work / "shell.inp").write_text(beams.deck(ratio, heights, beams.at[(shift, shift)][0]))
    run("ccx", "shell", cwd=work)
    steps, theirs = answers(work / "shell.dat")
    with open(work / "modes" / "modes.csv") as table:
        ours = [float(row["frequency_Hz"]) for row in csv.DictReader(table)]
    height, off, moved, apart = 0.0, 0.0, 0.0, 0.0
    for place, nodes in beams.at.items():
        way = [b - a for a, b in zip(formed[place], loaded[place])]
        there = [b - a for a, b in zip(steps[2][nodes[0]], steps[3][nodes[0]])]
        at = [a + b for a, b in zip((*place, 0.0), steps[2][nodes[0]])]
        height = max(height, abs(formed[place][2]))
        off = max(off, math.dist(at, formed[place]))
        moved = max(moved, math.hypot(*way))
        apart = max(apart, math.dist(way, there))
    worst = max(abs(b / a - 1) for a, b in zip(ours, theirs))
    good = (len(theirs) == COUNT and off < 0.01 * height and apart < 0.01 * moved and worst < 0.01)
    print(f"{name}: {height:.4g} mm high, joints {off:.2g} mm apart; under load the furthest goes "
          f"{moved:.3g} mm, {apart / moved:.2%} apart; frequencies " +
          ", ".join(f"{a:.5g} and {b:.5g}" for a, b in zip(ours, theirs)) +
          f" Hz, {worst:.2%} apart: {'ok' if good else 'FAILED'}")
    return good


def main():
    if not shutil.which("ccx"):
        print("left out: ccx (calculix-ccx) is not installed")
        sys.exit(77)
    good = True
    for name, size in SHELLS.items():
        with tempfile.TemporaryDirectory() as work:
            good &= compare(name, size, Path(sys.argv[1]).resolve(), Path(work))
    sys.exit(0 if good else 1)


main()
