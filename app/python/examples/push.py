"""Forms a shell from the flat state, pushes a joint and draws it: python3 push.py [picture.png]"""
import sys

import gridshell as gs

shell = gs.Session("s1_actuation", {"footprint.rods": 8, "footprint.radius_mm": 84,
                                    "actuation.radius_mm": 63})
shell.actuate()
print(f"{shell.height_mm:.2f} mm high, {shell.energies['bend']:.2f} mJ of bending")
for depth in range(1, 4):
    report = shell.push((0, 0), depth_mm=1)
    print(f"{depth} mm: {shell.force_N:.4f} N, {report.certificate}")
shell.picture(sys.argv[1] if len(sys.argv) > 1 else "pushed.png")
