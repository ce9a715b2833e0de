#!/usr/bin/env python3
"""reorder.py rows|shuffled|hilbert IN.obj OUT.obj: the same triangles in another order.

rows: as they are; shuffled: vertices and triangles at random; hilbert: vertices along a Hilbert curve through the
plane of x and y, triangles by their first vertex.
"""
import random
import sys

LEVELS = 16  # of the curve


def along_curve(x, y):
    distance, side = 0, 1 << (LEVELS - 1)
    while side > 0:
        right, up = int(x & side > 0), int(y & side > 0)
        distance += side * side * ((3 * right) ^ up)
        x, y = x & (side - 1), y & (side - 1)
        if not up:
            if right:
                x, y = side - 1 - x, side - 1 - y
            x, y = y, x
        side >>= 1
    return distance


def order_of(vertices, how):
    order = list(range(len(vertices)))
    if how == "shuffled":
        random.Random(1).shuffle(order)
    elif how == "hilbert":
        low = [min(v[k] for v in vertices) for k in (0, 1)]
        span = max(max(v[k] for v in vertices) - low[k] for k in (0, 1))
        cell = [[int((v[k] - low[k]) / span * (2**LEVELS - 1)) for k in (0, 1)] for v in vertices]
        order.sort(key=lambda i: along_curve(*cell[i]))
    return order


def main(how, source, target):
    words = [line.split() for line in open(source) if line[:2] in ("v ", "f ")]
    vertices = [[float(x) for x in w[1:4]] for w in words if w[0] == "v"]
    order = order_of(vertices, how)
    new = {old: i + 1 for i, old in enumerate(order)}
    faces = [[new[int(x.split("/")[0]) - 1] for x in w[1:4]] for w in words if w[0] == "f"]
    if how == "shuffled":
        random.Random(2).shuffle(faces)
    elif how == "hilbert":
        faces.sort(key=min)
    with open(target, "w") as out:
        out.writelines("v %.9g %.9g %.9g\n" % tuple(vertices[i]) for i in order)
        out.writelines("f %d %d %d\n" % tuple(f) for f in faces)


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in ("rows", "shuffled", "hilbert"):
        sys.exit(__doc__)
    main(*sys.argv[1:])
