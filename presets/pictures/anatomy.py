"""The figures that name the parts of a gridshell, as the program computes it.

PYTHONPATH=build/python python3 presets/pictures/anatomy.py [FOLDER]
writes anatomy.svg (flat grid and shell) and symbols.svg (one cell and one rod) into FOLDER, by default
the folder of this file.
"""
import math
import pathlib
import sys

import gridshell as gs

INK, PALE, RED, BLUE = "#222222", "#9a9a9a", "#c03028", "#2a62b0"
FONT = 'font-family="DejaVu Sans, Helvetica, Arial, sans-serif"'


class Drawing:
    """Lines and words in pixels, y down, written as SVG."""

    def __init__(self, width, height):
        self.width, self.height, self.parts = width, height, []

    def line(self, points, colour=INK, width=1.2, closed=False, fill="none", dash=""):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        shape = "polygon" if closed else "polyline"
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<{shape} points="{text}" fill="{fill}" stroke="{colour}" '
                          f'stroke-width="{width}" stroke-linejoin="round"{dashes}/>')

    def dot(self, at, radius=2.2, colour=INK):
        self.parts.append(f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="{radius}" fill="{colour}"/>')

    def arrow(self, start, end, colour=RED, both=False):
        self.line([start, end], colour, 1.4)
        for tip, tail in [(end, start)] + ([(start, end)] if both else []):
            angle = math.atan2(tip[1] - tail[1], tip[0] - tail[0])
            corners = [(tip[0] - 8 * math.cos(angle + a), tip[1] - 8 * math.sin(angle + a))
                       for a in (0.35, -0.35)]
            self.line([tip] + corners, colour, 0.8, closed=True, fill=colour)

    def text(self, at, words, colour=INK, size=13, anchor="middle"):
        self.parts.append(f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" {FONT} font-size="{size}" '
                          f'fill="{colour}" text-anchor="{anchor}">{words}</text>')

    def write(self, path):
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" '
                        f'height="{self.height}" viewBox="0 0 {self.width} {self.height}">\n'
                        '<rect width="100%" height="100%" fill="#ffffff"/>\n'
                        + "\n".join(self.parts) + "\n</svg>\n")


def sub(word, index):
    return f'{word}<tspan font-size="9" dy="4">{index}</tspan>'


def view(centre, scale, elevation):
    """A parallel projection that looks down by `elevation` radians along +y."""
    def to_pixel(point):
        x, y, z = point
        up = y * math.sin(elevation) + z * math.cos(elevation)
        return centre[0] + scale * x, centre[1] - scale * up
    return to_pixel


def circle(radius, to_pixel):
    return [to_pixel((radius * math.cos(a), radius * math.sin(a), 0))
            for a in (math.tau * k / 120 for k in range(120))]


def shells():
    """A circle of six rods per direction, flat and formed, on one mesh."""
    changes = {"footprint.rods": 6, "footprint.longest_leg": 1.8, "actuation.ratio": 0.7,
               "accuracy.edges_per_segment": 16}
    flat, formed = gs.Session("s1_actuation", changes), gs.Session("s1_actuation", changes)
    formed.actuate()
    return flat, formed


def joints_of(session):
    return {tuple(int(k) for k in joint): at for at, joint in enumerate(session.layout.joints)}


def draw_grid(picture, session, to_pixel, cell=None):
    nodes, joints = session.nodes, joints_of(session)
    if cell:
        i, j = cell
        corners = [joints[k] for k in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]
        picture.line([to_pixel(nodes[k]) for k in corners], BLUE, 0.5, True, fill="#cfe0f5")
    for rod in session.layout.rods:
        picture.line([to_pixel(nodes[k]) for k in rod], INK, 1.3)
        for end in (rod[0], rod[-1]):
            picture.dot(to_pixel(nodes[end]), 2.4, RED)
    for at in joints.values():
        picture.dot(to_pixel(nodes[at]), 2.0, "#555555")


def anatomy(flat, formed, path):
    picture = Drawing(840, 330)
    original, actuated = flat.layout.length_scale_mm, formed.boundary_radius_mm
    nodes, joints = flat.nodes, joints_of(flat)

    # the flat grid, seen from above
    to_pixel = view((170, 160), 1.55, math.pi / 2)
    picture.line(circle(original, to_pixel), PALE, 1.2, True)
    draw_grid(picture, flat, to_pixel, (1, 0))
    picture.arrow(to_pixel((0, 0, 0)), to_pixel((-0.94 * original, -0.342 * original, 0)))
    picture.text((112, 196), sub("R", "o"), RED, 15)
    left, right = (to_pixel(nodes[joints[k, -1]]) for k in (-1, 0))
    picture.arrow((left[0], left[1] + 8), (right[0], right[1] + 8), both=True)
    picture.text(((left[0] + right[0]) / 2, left[1] + 25), "d", RED, 15)
    end = max((nodes[rod[-1]] for rod in flat.layout.rods), key=lambda p: p[0] + 0.01 * p[1])
    last = nodes[joints[2, 0]]
    low = min((nodes[rod[-1]] for rod in flat.layout.rods), key=lambda p: abs(p[1] + 30) - p[0])
    notes = [(to_pixel((35, 12, 0)), (325, 60), "cell", BLUE),
             (to_pixel(nodes[joints[2, 1]]), (325, 95), "joint", "#555555"),
             (to_pixel((end + last) / 2), (325, 130), "leg", INK),
             (to_pixel(low), (325, 205), "edge point, pinned", RED)]
    for start, stop, words, colour in notes:
        picture.line([start, stop], colour, 0.9)
        picture.text((stop[0] + 4, stop[1] + 4), words, colour, 13, "start")
    picture.text((170, 322), "flat grid of rods (footprint)", INK, 14)

    # the shell
    to_pixel = view((655, 205), 1.9, 0.4)
    picture.line(circle(original, to_pixel), PALE, 1, True, dash="4 4")
    picture.line(circle(actuated, to_pixel), INK, 1.4, True)
    draw_grid(picture, formed, to_pixel, (1, 0))
    foot = to_pixel((0, 0, 0))
    picture.arrow(foot, to_pixel((actuated, 0, 0)))
    picture.text((foot[0] + 55, foot[1] + 18), sub("R", "a"), RED, 15)
    picture.arrow((432, 230), (477, 230), INK)
    picture.text((650, 322), "shell in equilibrium", INK, 14)
    picture.write(path)


def symbols(flat, formed, path):
    picture = Drawing(840, 300)
    nodes, joints = formed.nodes, joints_of(formed)

    # indices of rods, joints and cells
    to_pixel = view((150, 142), 1.4, math.pi / 2)
    picture.line(circle(flat.layout.length_scale_mm, to_pixel), PALE, 1, True)
    draw_grid(picture, flat, to_pixel, (0, 0))
    for k in (-1, 0, 1):
        u = [rod for rod, family in zip(flat.layout.rods, flat.layout.families) if family == "u"]
        v = [rod for rod, family in zip(flat.layout.rods, flat.layout.families) if family == "v"]
        tip = to_pixel(max((flat.nodes[n] for n in u[k + 3]), key=lambda p: p[0]))
        picture.text((tip[0] + 18, tip[1] + 4), f"u{k:+d}", INK, 12)
        tip = to_pixel(max((flat.nodes[n] for n in v[k + 3]), key=lambda p: p[1]))
        picture.text((tip[0], tip[1] - 8), f"v{k:+d}", INK, 12)
    at = to_pixel(flat.nodes[joints_of(flat)[0, 0]])
    picture.line([at, (60, 270)], BLUE, 0.8)
    picture.text((30, 284), "joint (0, 0), of rods u+0 and v+0, and its cell", BLUE, 12, "start")

    # one cell, seen along its normal, and its angles
    corners = [joints[k] for k in ((1, -1), (2, -1), (2, 0), (1, 0))]
    middle = sum(nodes[k] for k in corners) / 4
    across = nodes[corners[1]] - nodes[corners[3]]
    across = across / math.hypot(*across)
    along = nodes[corners[2]] - nodes[corners[0]]
    along = along - (along @ across) * across
    along = along / math.hypot(*along)

    def to_cell(point):
        return (430 + 4.6 * float((point - middle) @ across),
                135 - 4.6 * float((point - middle) @ along))

    sides = []
    for a, b in zip(corners, corners[1:] + corners[:1]):
        for rod in formed.layout.rods:
            rod = [int(n) for n in rod]
            if a in rod and b in rod:
                p, q = sorted((rod.index(a), rod.index(b)))
                piece = rod[p:q + 1] if rod[p] == a else rod[p:q + 1][::-1]
                sides.append([to_cell(nodes[n]) for n in piece])
                beyond = [to_cell(nodes[n]) for n in rod[max(0, p - 5):q + 6]]
                picture.line(beyond, INK, 1.4)
    picture.line([point for side in sides for point in side[:-1]], BLUE, 0.5, True, fill="#cfe0f5")
    for side, before, number in zip(sides, sides[-1:] + sides[:-1], (1, 2, 3, 4)):
        corner = side[0]
        ends = []
        for other in (side[4], before[-5]):
            length = math.dist(corner, other)
            ends.append([corner[k] + 26 * (other[k] - corner[k]) / length for k in (0, 1)])
            picture.arrow(corner, [corner[k] + 46 * (other[k] - corner[k]) / length for k in (0, 1)])
        picture.line(ends, RED, 1)
        inner = [(ends[0][k] + ends[1][k]) / 2 - corner[k] for k in (0, 1)]
        picture.text((corner[0] + 1.7 * inner[0], corner[1] + 1.7 * inner[1] + 4), sub("α", number), RED, 14)
    picture.text((440, 284), "K□ = 2π − (α" + "".join(
        f'<tspan font-size="9" dy="4">{k}</tspan><tspan dy="-4">{more}</tspan>'
        for k, more in zip((1, 2, 3, 4), (" + α", " + α", " + α", ")"))), BLUE, 14)

    # one rod: edges, segments, legs
    rod = [int(n) for n in formed.layout.rods[3]][::4]
    start = nodes[rod[0]]
    chord = (nodes[rod[-1]] - start) / math.dist(nodes[rod[-1]], start)
    points = [(600 + 1.7 * float((nodes[n] - start) @ chord),
               200 - 1.7 * float(nodes[n][2])) for n in rod]
    picture.line(points, INK, 1.4)
    for n, point in zip(rod, points):
        picture.dot(point, 3.2 if n in joints.values() else 1.6, "#555555")
    for point in (points[0], points[-1]):
        picture.dot(point, 3.2, RED)
    near = [k for k, n in enumerate(rod) if n in joints.values()]
    picture.line([points[near[1] + 1], (620, 50)], INK, 0.8)
    picture.text((620, 44), "edge", INK, 13)
    picture.line([points[near[3] + 2], (745, 50)], INK, 0.8)
    picture.text((745, 44), "segment, joint to joint", INK, 13)
    picture.line([points[2], (600, 235)], INK, 0.8)
    picture.text((600, 250), "leg", INK, 13)
    picture.line([points[near[4]], (720, 235)], INK, 0.8)
    picture.text((725, 250), "joint", INK, 13)
    picture.text((715, 284), "a rod on 4 edges per segment", INK, 13)
    picture.write(path)


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
    pair = shells()
    anatomy(*pair, folder / "anatomy.svg")
    symbols(*pair, folder / "symbols.svg")
