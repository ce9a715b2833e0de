#!/usr/bin/env python3
"""Writes an arm that bends at its elbow and straightens: arm.obj, its triangles, and arm.mdd, its motion.

    make_arm.py [--out DIR] [--around 48] [--along 66] [--degrees 110] [--bends 1] [--fps 25]

The arm is a swept surface along x, the elbow at x = 0, closed at both ends.  Its middle line bends in the plane z = 0,
within 0.09 m to both sides of the elbow, by an angle that grows along it as smoothstep does, so that its curvature ends
in 0 and the inside of the elbow stays free of the arm itself.  In time it rests for `hang` seconds, bends within `bend`,
stays for `hold`, straightens within `bend`, and rests; `--bends` repeats that.  It needs numpy.
"""
import argparse
import pathlib
import struct

import numpy as np

LENGTH = 0.24  # of the upper arm and of the forearm [m]
JOINT = 0.09  # half the length over which the elbow bends [m]
SHOULDER, ELBOW, WRIST = 0.042, 0.036, 0.030  # radii [m]
HANG, BEND, BETWEEN, HOLD, REST = 0.3, 0.9, 0.1, 0.3, 0.6  # [s], as the phases of assets/scenes/sleeve-on-arm.toml


def smoothstep(u):
    u = np.clip(u, 0, 1)
    return u * u * (3 - 2 * u)


def radius(s):
    """Of the arm at the length s along its middle line [m]."""
    upper = ELBOW + (SHOULDER - ELBOW) * smoothstep(-s / LENGTH)
    return np.where(s < 0, upper, WRIST + (ELBOW - WRIST) * (1 - smoothstep(s / LENGTH)))


def middle_line(stations, angle, joint=JOINT):
    """Points and unit tangents where a limb is bent by `angle` [rad], within `joint` to both sides, at these lengths
    from there [m]."""
    fine = np.linspace(stations[0], stations[-1], 4001)
    turned = angle * smoothstep((fine + joint) / (2 * joint))
    tangent = np.stack([np.cos(turned), np.sin(turned)], 1)
    step = np.diff(fine)[:, None] * 0.5 * (tangent[1:] + tangent[:-1])
    line = np.concatenate([[[stations[0], 0]], [stations[0], 0] + np.cumsum(step, 0)])
    at = np.stack([np.interp(stations, fine, line[:, axis]) for axis in (0, 1)], 1)
    turned = np.interp(stations, fine, turned)
    return at, np.stack([np.cos(turned), np.sin(turned)], 1)


def frame(angle, around, along):
    """Vertices of the bent arm [m]: rings from the shoulder to the wrist, then the two poles."""
    caps = 5  # rings of each rounded end
    u = np.sin(np.linspace(0, 0.5 * np.pi, caps + 1)[1:-1])  # of the ends' depth
    ends = np.cos(np.linspace(0, 0.5 * np.pi, caps + 1)[1:-1])
    rings = np.linspace(-LENGTH, LENGTH, along)
    first, last = radius(rings[:1])[0], radius(rings[-1:])[0]
    stations = np.concatenate([(-LENGTH - first * u)[::-1], rings, LENGTH + last * u])
    radii = np.concatenate([(first * ends)[::-1], radius(rings), last * ends])
    poles = np.array([-LENGTH - first, LENGTH + last])
    at, tangent = middle_line(np.concatenate([poles[:1], stations, poles[1:]]), angle)
    normal = np.stack([-tangent[:, 1], tangent[:, 0]], 1)
    turn = 2 * np.pi * np.arange(around) / around
    ring = radii[:, None, None] * (np.cos(turn)[None, :, None] * np.pad(normal[1:-1], ((0, 0), (0, 1)))[:, None]
                                   + np.sin(turn)[None, :, None] * np.array([0, 0, 1.0]))
    flat = np.pad(at, ((0, 0), (0, 1)))
    return np.concatenate([(flat[1:-1, None] + ring).reshape(-1, 3), flat[[0, -1]]])


def triangles(rings, around):
    """Counter-clockwise from outside, numbered from 0."""
    faces = []
    for i in range(rings - 1):
        for j in range(around):
            a, b = i * around + j, i * around + (j + 1) % around
            c, d = a + around, b + around
            faces += [(a, d, c), (a, b, d)] if (i + j) % 2 else [(a, b, c), (b, d, c)]
    start, end, last = rings * around, rings * around + 1, (rings - 1) * around
    for j in range(around):
        faces += [(start, (j + 1) % around, j), (end, last + j, last + (j + 1) % around)]
    return np.array(faces)


def angle_at(time, degrees, bends):
    cycle = HANG + 2 * (BEND + BETWEEN) + HOLD
    within = time - min(int(time / cycle), bends - 1) * cycle - HANG
    bent = smoothstep(within / BEND) - smoothstep((within - BEND - BETWEEN - HOLD) / BEND)
    return np.radians(degrees) * bent


def write_body(stem, title, times, frames, faces):
    """The triangles, where the first frame has them, as `stem`.obj, and all frames as `stem`.mdd."""
    with open(stem.with_suffix(".obj"), "w", encoding="ascii") as file:
        file.write(f"# {title}\n")
        file.writelines("v {:.6g} {:.6g} {:.6g}\n".format(*x) for x in frames[0])
        file.writelines("f {} {} {}\n".format(*f) for f in faces + 1)
    with open(stem.with_suffix(".mdd"), "wb") as file:
        file.write(struct.pack(">ii", len(times), len(frames[0])))
        file.write(np.asarray(times, ">f4").tobytes())
        for x in frames:
            file.write(x.astype(">f4").tobytes())
    print(f"{stem.name}: {len(frames[0])} vertices, {len(faces)} triangles, {len(times)} frames over {times[-1]:g} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).parent, metavar="DIR")
    parser.add_argument("--around", type=int, default=48, help="vertices of a ring")
    parser.add_argument("--along", type=int, default=66, help="rings between the ends")
    parser.add_argument("--degrees", type=float, default=110)
    parser.add_argument("--bends", type=int, default=1)
    parser.add_argument("--fps", type=float, default=25)
    asked = parser.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    seconds = asked.bends * (HANG + 2 * (BEND + BETWEEN) + HOLD) + REST
    times = np.arange(round(seconds * asked.fps) + 1) / asked.fps
    frames = [frame(angle_at(time, asked.degrees, asked.bends), asked.around, asked.along) for time in times]
    faces = triangles((len(frames[0]) - 2) // asked.around, asked.around)
    title = "An arm along x, its elbow at the origin [m]; made by make_arm.py."
    write_body(asked.out / "arm", title, times, frames, faces)


if __name__ == "__main__":
    main()
