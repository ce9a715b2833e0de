#!/usr/bin/env python3
"""Writes the right half of a pair of trousers for the leg of make_leg.py: trousers.obj, a pattern of two panels.

    make_trousers.py [--out DIR] [--down 39] [--front 9] [--back 10]

Its vertices are where the cloth starts: around the straight leg, 8 to 44 mm off it, and cut at the middle of the body,
x = 0, along the rise: down from the waist in front, under the crotch and up behind.  Its texture coordinates [m] are
the front and the back panel laid flat, u along the leg (warp); the outseam and the inseam, whose vertices both panels
share, are what is sewn.  Each panel is unrolled as rigidly as its curvature allows (Liu, Zhang, Xu, Gotsman & Gortler
2008, "A local/global approach to mesh parameterization").  The script says how long the seams are on either side and
how far the start stretches the cloth.  It needs numpy.

Its options are rows of triangles from the waist to the hem and columns of either panel: fewer for a quick run,

    make_trousers.py --out /tmp --down 28 --front 6 --back 7
    hysteron crumple --scene trousers --cloth.file /tmp/trousers.obj --cloth.subdivisions 0
"""
import argparse
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "bodies"))
from make_leg import DENSE, outline, smoothstep  # noqa: E402

# Sections of the cloth, as those of the leg: height, middle x and y, half breadth, half depth [m], exponent.
CLOTH = np.array([(0.985, 0.069, -0.0080, 0.103, 0.120, 2.7),
                  (0.90, 0.072, -0.0090, 0.110, 0.127, 2.7),
                  (0.82, 0.0785, -0.0080, 0.1085, 0.124, 2.5),
                  (0.75, 0.0955, -0.0075, 0.0935, 0.1145, 2.3),
                  (0.66, 0.0960, -0.0072, 0.0895, 0.1085, 2.2),
                  (0.48, 0.0980, -0.0066, 0.0815, 0.0960, 2.1),
                  (0.12, 0.100, -0.0060, 0.0740, 0.0800, 2.0)])
WAIST, HEM = CLOTH[0, 0], CLOTH[-1, 0]
CROTCH, SIDE = 0.755, 0.77  # heights of the row that passes the crotch: there, and on the outer side [m]
CURVE = 0.09  # height of the rise's curve above the crotch [m]
SEAM = 0.15  # angle by which both seams lie before the middle of a section [rad]: the back is wider
ITERATIONS = 100  # of unrolling


def lengths(points):
    """From the first of them to each along the line that they make."""
    return np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])


def at_lengths(points, length, wanted):
    return np.stack([np.interp(wanted, length, points[:, axis]) for axis in (0, 1)], -1)


def half_section(z, side):
    """Points (x, y) from the outseam over the front (side = 1) or the back (-1) to the inseam, no farther than the
    middle of the body, and their lengths from the outseam [m]."""
    inseam = np.pi - SEAM if side > 0 else -np.pi - SEAM
    points = outline(CLOTH, z, np.linspace(SEAM, inseam, DENSE))
    points[:, 0] = np.maximum(points[:, 0], 0)
    return points, lengths(points)


def corner(z, side):
    """Number of the first point of such a section in the middle of the body."""
    return np.argmax(half_section(z, side)[0][:, 0] <= 0)


def rise(side, rows):
    """Heights and y of the rise, (rows + 1, 2), from the waist to the crotch, at equal lengths: down along the middle
    of the body, then a quarter of an ellipse."""
    straight = np.linspace(WAIST, CROTCH + CURVE, 200)
    line = np.array([(z, half_section(z, side)[0][corner(z, side), 1]) for z in straight])
    depth, middle = line[-1, 1], half_section(CROTCH, side)[0][-1, 1]
    turn = np.linspace(0, np.pi / 2, 200)[1:]
    curve = np.stack([CROTCH + CURVE * (1 - np.sin(turn)), middle + (depth - middle) * np.cos(turn)], 1)
    line = np.concatenate([line, curve])
    length = lengths(line)
    return at_lengths(line, length, np.linspace(0, length[-1], rows + 1))


def end_of_row(z, side, y=None):
    """Part of a half section at which a row ends: all of it, or on the rise, which is there at y."""
    if y is None:
        return 1
    points, length = half_section(z, side)
    at = corner(z, side)
    return (length[at] + abs(y - points[at, 1])) / length[-1]


def worn_panel(side, above, below, columns):
    """Where its vertices start, (rows, columns, 3): rows from the waist to the hem, columns as seen from outside, from
    left to right.  Rows down to the crotch end on the rise, `below` more on the inseam."""
    on_rise = rise(side, above)
    outer = np.concatenate([np.linspace(WAIST, SIDE, above + 1), np.linspace(SIDE, HEM, below + 1)[1:]])
    inner = np.concatenate([on_rise[:, 0], np.linspace(CROTCH, HEM, below + 1)[1:]])
    part = np.linspace(0, 1, columns + 1)
    panel = np.empty((len(outer), columns + 1, 3))
    for k in range(len(outer)):
        end = end_of_row(inner[k], side, on_rise[k, 1] if k < above else None)
        panel[k, :, 2] = outer[k] + (inner[k] - outer[k]) * smoothstep(part)
        for j, z in enumerate(panel[k, :, 2]):
            points, length = half_section(z, side)
            panel[k, j, :2] = at_lengths(points, length, part[j] * end * length[-1])
    return panel if side > 0 else panel[:, ::-1]


def grid_triangles(rows, columns):
    """Of a grid of vertices that are numbered row by row, counter-clockwise where rows go down and columns right."""
    faces = []
    for k in range(rows):
        for j in range(columns):
            a = k * (columns + 1) + j
            b, c, d = a + 1, a + columns + 1, a + columns + 2
            faces += [(a, c, d), (a, d, b)] if (k + j) % 2 else [(a, c, b), (b, c, d)]
    return np.array(faces)


def sides_in_their_planes(worn, faces):
    """Each triangle's sides in its own plane, (faces, 3, 2): from corner k to corner k + 1."""
    first, second = worn[faces[:, 1]] - worn[faces[:, 0]], worn[faces[:, 2]] - worn[faces[:, 0]]
    length = np.linalg.norm(first, axis=1)
    corners = np.zeros((len(faces), 3, 2))
    corners[:, 1, 0] = length
    corners[:, 2, 0] = np.einsum("fi,fi->f", first, second) / length
    corners[:, 2, 1] = np.linalg.norm(np.cross(first, second), axis=1) / length
    return corners[:, [1, 2, 0]] - corners


def half_cotangents(sides):
    """Of the angle opposite to each side of a triangle."""
    square = np.einsum("fki,fki->fk", sides, sides)
    twice_area = sides[:, 0, 0] * sides[:, 1, 1]
    return (square[:, [1, 2, 0]] + square[:, [2, 0, 1]] - square) / (4 * twice_area[:, None])


def straight_rows(panel):
    """A first guess, (vertices, 2): rows lie straight, their vertices as far apart as worn, rows as in the mean."""
    across = np.linalg.norm(np.diff(panel, axis=1), axis=2)
    down = np.linalg.norm(np.diff(panel, axis=0), axis=2).mean(1)
    v = np.pad(np.cumsum(across, axis=1), ((0, 0), (1, 0)))
    u = np.broadcast_to(np.concatenate([[0], np.cumsum(down)])[:, None], v.shape)
    return np.stack([u, v], -1).reshape(-1, 2)


def unrolled(panel, faces):
    """The panel laid flat, (vertices, 2): sides as near as may be to those worn, turned triangle by triangle."""
    start, end = faces, faces[:, [1, 2, 0]]
    sides = sides_in_their_planes(panel.reshape(-1, 3), faces)
    weight = half_cotangents(sides)
    at = straight_rows(panel)
    system = np.zeros((len(at), len(at)))
    for i, j, sign in ((start, start, 1), (end, end, 1), (start, end, -1), (end, start, -1)):
        np.add.at(system, (i, j), sign * weight)
    system[0] = 0
    system[0, 0] = 1  # the first vertex stays in the origin
    inverse = np.linalg.inv(system)
    for _ in range(ITERATIONS):
        left, _, right = np.linalg.svd(np.einsum("fk,fki,fkj->fij", weight, at[end] - at[start], sides))
        right[np.linalg.det(left @ right) < 0, 1] *= -1  # turned, not mirrored
        pull = weight[..., None] * np.einsum("fij,fkj->fki", left @ right, sides)
        load = np.zeros_like(at)
        np.add.at(load, end, pull)
        np.add.at(load, start, -pull)
        load[0] = 0
        at = inverse @ load
    return at


def upright(at, shape):
    """Turned so that the middles of the knee and of the hem lie in one line along u, and moved to begin at 0, 0."""
    grid = at.reshape(*shape, 2)
    line = grid[-1].mean(0) - grid[shape[0] // 2].mean(0)
    cos, sin = line / np.linalg.norm(line)
    turned = at @ np.array([[cos, -sin], [sin, cos]])
    return turned - turned.min(0)


def sewn(front, back, above):
    """Numbers of the vertices of both panels, from 0 on: those of the back on the outseam, and on the inseam from the
    row `above` on, are those of the front."""
    first = np.arange(front[0] * front[1]).reshape(front)
    second = np.full(back, -1)
    second[:, -1] = first[:, 0]
    second[above:, 0] = first[above:, -1]
    own = second < 0
    second[own] = first.size + np.arange(own.sum())
    return first, second


def report(panels, flat, faces, above):
    """How long both sides of each seam are, and how far the start stretches the sides of the triangles."""
    grids = [at.reshape(*panel.shape[:2], 2) for panel, at in zip(panels, flat)]
    for name, sides in (("outseam", (grids[0][:, 0], grids[1][:, -1])),
                        ("inseam", (grids[0][above:, -1], grids[1][above:, 0]))):
        print("{}: {:.1f} mm in front, {:.1f} mm behind".format(name, *(1e3 * lengths(side)[-1] for side in sides)))
    strain = []
    for panel, at, own in zip(panels, flat, faces):
        start, end = own, own[:, [1, 2, 0]]
        worn = panel.reshape(-1, 3)
        strain.append(np.linalg.norm(worn[end] - worn[start], axis=2) / np.linalg.norm(at[end] - at[start], axis=2) - 1)
    strain = 100 * np.concatenate(strain).ravel()
    print("{} triangles; at the start their sides are stretched by {:.1f} % (rms), {:.1f} to {:.1f} %".format(
        len(strain) // 3, np.sqrt((strain**2).mean()), strain.min(), strain.max()))


def write_pattern(file, panels, flat, faces, numbers):
    worn = np.empty((max(n.max() for n in numbers) + 1, 3))
    for panel, own in zip(panels, numbers):
        worn[own] = panel
    beside = flat[1] + [0, flat[0][:, 1].max() + 0.02]
    file.write("# The right half of a pair of trousers, for leg.obj; its texture coordinates are two panels [m], warp\n"
               "# along the first; made by make_trousers.py.\n")
    file.writelines("v {:.6f} {:.6f} {:.6f}\n".format(*x) for x in worn)
    file.writelines("vt {:.6f} {:.6f}\n".format(*x) for x in np.concatenate([flat[0], beside]))
    for name, own, number, first in zip(("front", "back"), faces, numbers, (1, 1 + len(flat[0]))):
        file.write(f"g {name}\n")
        vertex = 1 + number.ravel()[own]
        file.writelines("f {}/{} {}/{} {}/{}\n".format(*corner)
                        for corner in np.stack([vertex, first + own], -1).reshape(-1, 6))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).parent, metavar="DIR")
    parser.add_argument("--down", type=int, default=39, help="rows of triangles from the waist to the hem")
    parser.add_argument("--front", type=int, default=9, help="columns of the front panel")
    parser.add_argument("--back", type=int, default=10, help="columns of the back panel")
    asked = parser.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    above = round(asked.down / 4)
    panels = [worn_panel(side, above, asked.down - above, columns)
              for side, columns in ((1, asked.front), (-1, asked.back))]
    faces = [grid_triangles(asked.down, columns) for columns in (asked.front, asked.back)]
    flat = [upright(unrolled(panel, own), panel.shape[:2]) for panel, own in zip(panels, faces)]
    report(panels, flat, faces, above)
    with open(asked.out / "trousers.obj", "w", encoding="ascii") as file:
        write_pattern(file, panels, flat, faces, sewn(panels[0].shape[:2], panels[1].shape[:2], above))


if __name__ == "__main__":
    main()
