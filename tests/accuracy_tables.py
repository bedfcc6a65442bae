#!/usr/bin/env python3
"""The tables of engine/accuracy.md: tests/accuracy_tables.py PROGRAM [NAME...] [--check]

Runs the commands that each table names and writes the table between its marks in the page,
<!-- table: NAME --> and <!-- end -->. --check writes nothing and fails where a table differs in more
than its times (columns that end in " s" or "GB"). Without names it makes all of them but `trust`,
which takes a quarter of an hour.
"""
import csv
import json
import math
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

page = pathlib.Path(__file__).parent.parent / "engine/accuracy.md"
arguments = [a for a in sys.argv[1:] if a != "--check"]
program = pathlib.Path(arguments[0]).resolve()
commands = []


def run(arguments, folder):
    """Runs `gridshell ARGUMENTS -o FOLDER`; returns its CPU time in seconds."""
    command = ["gridshell"] + arguments
    commands.append(" ".join(f"'{a}'" if re.search(r"[{}\[\]*]", a) else a for a in command))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ended = subprocess.run(["/usr/bin/env", program] + arguments + ["--quiet", "-o", folder],
                           capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if ended.returncode not in (0, 1, 3):
        sys.exit(f"{commands[-1]}: {ended.stderr}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def summary(folder):
    return json.loads(pathlib.Path(folder, "summary.json").read_text())


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def joints(folder):
    return [[float(row[k]) for k in ("x_mm", "y_mm", "z_mm")] for row in rows(folder + "/joints.csv")]


def number(x, digits=2):
    """x with so many significant digits: 2.6e-4, 0.013, 12; nothing for None and ''."""
    if x is None or x == "":
        return ""
    x = float(x)
    if x == 0 or 0.001 <= abs(x) < 10000:
        return f"{x:.{max(0, digits - 1 - math.floor(math.log10(abs(x))))}f}" if x else "0"
    mantissa, exponent = f"{x:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def with_error(x, error):
    """4.13 ± 0.04: both are rounded to the first significant digit of the error; without an error that
    is known and above 0, x alone."""
    if error in (None, "") or not float(error) > 0:
        return number(x, 4)
    x, error = float(x), float(error)
    digits = max(0, -math.floor(math.log10(error)))
    return f"{x:.{digits}f} ± {error:.{digits}f}"


def percent(x):
    return f"{100 * float(x):.3f} %"


def convergence():
    reference = ["run", "s1_actuation", "--frames", "2", "--set", "accuracy.tolerance=1e-8"]
    run(reference, "reference")
    exact = joints("reference")
    yield ["edges per segment", "unknowns", "error over R_o", "ratio"]
    last = None
    for edges in (2, 4, 8, 16, 32):
        run(["run", "s1_actuation", "--frames", "2", "--set", f"accuracy.edges_per_segment={edges}"], f"edges{edges}")
        error = max(math.dist(a, b) for a, b in zip(joints(f"edges{edges}"), exact)) / 126
        yield [edges, summary(f"edges{edges}")["dof"], number(error), f"{last / error:.1f}" if last else ""]
        last = error


def tolerance():
    run(["run", "s1_actuation", "--frames", "2", "--set", "accuracy.tolerance=1e-8"], "reference")
    exact = joints("reference")
    yield ["tolerance", "edges per segment", "error over R_o", "estimate over R_o", "factorisations", "CPU s"]
    for value in ("1e-2", "1e-3", "1e-4", "1e-5", "1e-6"):
        seconds = run(["run", "s1_actuation", "--frames", "2", "--threads", "1", "--set", f"accuracy.tolerance={value}"], value)
        found = summary(value)
        error = max(math.dist(a, b) for a, b in zip(joints(value), exact)) / 126
        yield [value, found["edges_per_segment"], number(error), number(found["error_estimate_mm"] / 126),
               found["factorizations"], f"{seconds:.2f}"]


def size():
    yield ["rods per direction", "unknowns", "edges per segment", "end of the path", "factorisations", "CPU s"]
    for rods, radius in ((12, 126), (24, 246), (48, 486)):
        seconds = run(["run", "s1_actuation", "--frames", "2", "--threads", "1",
                       "--set", f"footprint.rods={rods}", "--set", f"footprint.radius_mm={radius}",
                       "--set", "actuation.ratio=0.75", "--set", "accuracy.tolerance=1e-3"], f"rods{rods}")
        found = summary(f"rods{rods}")
        yield [rods, found["dof"], found["edges_per_segment"],
               "R_a = 0.75 R_o" if found["limit"] in ("none", "snap") else found["limit"],
               found["factorizations"], f"{seconds:.2f}"]


def circle():
    yield ["run", "bend energy (mJ)", "highest joint, lowest point (mm)", "unstable for R_a/R_o", "what happens on the path"]
    for words, arguments in (("symmetric", ["s1_actuation"]), ("with an imperfection", ["s1_imperfect"]),
                             ("symmetric, to half the radius", ["s1_actuation", "--set", "actuation.ratio=0.5"])):
        run(["run"] + arguments + ["--frames", "241"], words)
        found = summary(words)
        ratios = [float(frame["boundary_radius_mm"]) / 126 for frame in rows(words + "/frames.csv")
                  if int(frame["negative_pivots"] or 0) > 0]
        yield [words, f"{found['energy_bend_mJ']:.3f}", f"{found['height_mm']:.2f}, {found['lowest_mm']:.2f}",
               f"{max(ratios):.3f} to {min(ratios):.3f}" if ratios else "never", found["limit_reason"] or "no snap"]


def caps():
    yield ["z\\*/rho", "largest, on axes", "mean", "largest, half", "mean"]
    tables = {}
    for placement in ("on_axis", "half"):
        run(["sweep", "fig3_hemisphere", "--set", "sweep.over={net.cut_height=[0,0.3,0.5,0.7,0.8,0.9]}",
             "--set", "net.radius_mm=120", "--set", f"footprint.placement={placement}",
             "--set", "accuracy.tolerance=1e-6"], placement)
        tables[placement] = rows(placement + "/sweep.csv")
    for a, b in zip(tables["on_axis"], tables["half"]):
        yield [a["net.cut_height"]] + [percent(row[key]) for row in (a, b) for key in ("max_deviation", "mean_deviation")]


def pushes():
    yield ["rods", "push", "force (N)", "total K (rad)", "its change", "joints that moved by 0.1, by 0.5 of the depth"]
    for placement in ("on_axis", "half"):
        run(["run", "s2_indentation", "--frames", "11", "--set", "net.radius_mm=120", "--set", f"footprint.placement={placement}",
             "--set", "accuracy.edges_per_segment=32"], placement)
        for case, words in (("pole_inward", "inward, pole"), ("pole_outward", "outward, pole"), ("oblique_inward", "inward, 45°")):
            frames = rows(f"{placement}/{case}/frames.csv")
            first, last = float(frames[0]["total_K"]), frames[-1]
            yield [placement, words, f"{float(last['force_N']):.4f}", f"{first:.4f}", f"{100 * (float(last['total_K']) / first - 1):+.2f} %",
                   f"{100 * float(last['reach_above_tenth']):.0f} %, {100 * float(last['reach_above_half']):.0f} %"]


def designs():
    yield ["what is moved", "`norm`", "largest", "mean", "furthest move", "lowest eigenvalue over that before", "largest if pins are off by 0.1 mm", "CPU s"]
    for words, vary, norm in (("pins, radially", "pins_radial", 6), ("pins in the plane", "pins", 8), ("legs", "legs", 12),
                              ("directions of tangent ends", "directions", 8), ("diameters", "diameters", 8)):
        ends = ["--set", "ends.kind=tangent"] if vary == "directions" else []
        run(["design", "design_hemisphere", "--set", f'inverse.vary=["{vary}"]', "--set", f"inverse.norm={norm}",
             "--quality", "draft", "--size", "160x100"] + ends, vary)
        found = json.loads(pathlib.Path(vary, "design.json").read_text())
        if vary == "pins_radial":
            yield ["nothing", "", percent(found["max_before"]), percent(found["mean_before"]), "", "1", "", ""]
        move = {"directions": f"{found['largest_turn_deg']:.2f}°", "diameters": f"{100 * found['largest_thickening']:.0f} %"}
        yield [words, norm, percent(found["max_after"]), percent(found["mean_after"]),
               move.get(vary, f"{found['largest_move_mm']:.1f} mm"),
               f"{found['eigenvalue_after'] / found['eigenvalue_before']:.2f}", percent(found["fabricated"][0]["max"]),
               f"{found['cpu_s']:.1f}"]
    run(["run", "ring_hemisphere", "--frames", "2"], "ring")
    found = summary("ring")
    yield ["nothing; a second ring of 10 mm", "", percent(found["max_deviation"]), percent(found["mean_deviation"]), "", "", "", ""]


def surfaces():
    yield ["preset", "before: largest, mean", "after: largest, mean", "furthest move", "iterations", "CPU s"]
    for preset in ("surface_paraboloid", "surface_ellipsoid", "surface_bump", "surface_mesh"):
        run(["design", preset, "--quality", "draft", "--size", "160x100"], preset)
        found = json.loads(pathlib.Path(preset, "design.json").read_text())
        scale = found["length_scale_mm"]
        yield [f"`{preset}`"] + [f"{scale * found['max_' + when]:.2f}, {scale * found['mean_' + when]:.2f} mm" for when in ("before", "after")] + [
            f"{found['largest_move_mm']:.1f} mm", found["iterations"], f"{found['cpu_s']:.1f}"]


def blocks():
    yield ["preset", "joints", "largest gap of a seam", "largest kink", "shell from its blocks, largest", "mean"]
    for preset in ("fig5_stadium", "fig5_peanut"):
        run(["run", preset, "--frames", "2"], preset)
        found = summary(preset)
        off = [float(row["deviation_mm"]) for row in rows(preset + "/joints.csv")]
        yield [f"`{preset}`", found["joints"], f"{found['max_seam_gap_mm']:.1f} mm", f"{found['max_seam_kink_deg']:.1f}°",
               f"{max(off):.1f} mm", f"{sum(off) / len(off):.1f} mm"]


def loads():
    yield ["case, at a factor of 1", "strength reached at", "stability lost at", "event", "linear estimate"]
    run(["load", "timber_vault", "--quality", "draft", "--size", "160x100"], "vault")
    for row in rows("vault/cases.csv"):
        kN = math.dist([0] * 3, [float(row[f"load_{axis}_N"]) for axis in "xyz"]) / 1000
        strength = with_error(row["strength_factor"], row["strength_error"]) if row["strength_factor"] else ""
        event = {"turn": "limit point"}.get(row["event"], row["event"])
        yield [f"{row['case']}, {kN:.1f} kN", strength, with_error(row["critical_factor"], row["error"]),
               event, with_error(row["linear_factor"], row["linear_error"])]


def states():
    yield ["class", "group", "bend energy (mJ)", "highest, lowest point (mm)", "exists from R_a/R_o", "lowest eigenvalue (N/mm²)"]
    run(["run", "fig2_states"], "states")
    met = set()  # states.csv is in order of energy: the first row of a class is its lowest state
    for row in rows("states/states.csv"):
        if row["class"] in ("i", "ii", "iii", "iv") and row["class"] not in met:
            met.add(row["class"])
            ratio = 1 - 0.25 * float(row["lives_to"])
            yield [row["class"], row["group"], f"{float(row['energy_bend_mJ']):.3f}", f"{float(row['z_max_mm']):.2f}, {float(row['z_min_mm']):.2f}",
                   f"{ratio:.3f}", number(row["eigenvalue_N_per_mm2"])]


def rigidity():
    yield ["figure", "exponent of", "exponent"]
    run(["sweep", "lit_rigidity"], "rigidity")
    for row in rows("rigidity/laws.csv"):
        yield [f"`{row['figure']}`", f"`{row['key']}`", f"{float(row['exponent']):.3f} ± {float(row['error']):.3f}"]


def trust():
    yield ["what came of it", "scenes"]
    study = [program.with_name("bench_trust"), "--scenes", "600", "--seed", "707", "-o", "trust"]
    commands.append("cmake --build build --target bench_trust\nbuild/bench_trust --scenes 600 --seed 707")
    if subprocess.run(study, capture_output=True).returncode not in (0, 3):
        sys.exit("bench_trust failed; it is built by `cmake --build build --target bench_trust`")
    counts = {}
    for row in rows("trust/trust.csv"):
        counts[row["class"]] = counts.get(row["class"], 0) + 1
    for outcome in sorted(counts, key=counts.get, reverse=True):
        yield [f"`{outcome}`", counts[outcome]]


def machine():
    for line in open("/proc/cpuinfo"):
        if line.startswith("model name"):
            return f"{line.split(':')[1].strip()}, {os.cpu_count()} cores"
    return "?"


def table(name):
    commands.clear()
    lines = list(globals()[name]())
    text = "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)
    head, rest = text.split("\n", 1)
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.strip()
    shown = [command for k, command in enumerate(commands) if command not in commands[:k]]
    shown = shown[:2] + (["# and with the other values of the first column"] if len(shown) > 2 else [])
    return (f"```sh not run\n" + "\n".join(shown) + "\n```\n\n" + head + "\n|" + " --- |" * len(lines[0]) + "\n" + rest
            + f"\n\n*gridshell {version}, {machine()}.*")


def without_times(text):
    lines = [line for line in text.split("\n") if line.startswith("|")]
    if not lines:
        return []
    cells = [line.split("|")[1:-1] for line in lines]
    keep = [k for k, title in enumerate(cells[0]) if not re.search(r" s $|GB $", title)]
    return [[row[k].strip() for k in keep] for row in cells]


text = page.read_text()
every = re.findall(r"<!-- table: (\w+) -->", text)
chosen = arguments[1:] or [name for name in every if name != "trust"]
different = []
with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)
    for name in chosen:
        os.makedirs(name)
        os.chdir(name)
        made = table(name)
        os.chdir("..")
        marks = re.compile(rf"(<!-- table: {name} -->\n).*?(<!-- end -->)", re.S)
        before = marks.search(text).group(0)
        if without_times(before) != without_times(made):
            different.append(name)
            print(f"{name} differs:\n{made}")
        text = marks.sub(lambda found: found.group(1) + made + "\n" + found.group(2), text)
if "--check" in sys.argv:
    sys.exit(1 if different else 0)
page.write_text(text)
