#!/usr/bin/env python3
"""Writes a leg whose knee bends and straightens: leg.obj, its triangles, and leg.mdd, its motion.

    make_leg.py [--out DIR] [--around 40] [--along 64] [--degrees 90] [--fps 25]

It is the right leg of a standing person who looks along y, from the waist to the ankle, the floor at z = 0 and the
middle of the body at x = 0, and is cut off 3 cm beyond that.  Its horizontal sections are superellipses, so that the
hip is a rounded box and the rest is round.  The shank swings back about the knee: within 0.1 m of it the leg bends, by
an angle that grows along it as smoothstep does, and keeps its length 12 mm behind the middle, where the joint is.  It
hangs for `hang` seconds, bends within `bend`, stays for `hold` and straightens within `bend`.  It needs numpy.
"""
import argparse
import pathlib

import numpy as np

from make_arm import middle_line, smoothstep, triangles, write_body

KNEE, JOINT = 0.48, 0.1  # its height, and half the length over which it bends [m]
NEUTRAL = -0.012  # where the length is kept when the knee bends: y [m]
HANG, BEND, BETWEEN, HOLD = 0.6, 0.9, 0.1, 0.4  # [s], as the phases of assets/scenes/trousers.toml
DENSE = 2880  # points of a section, between which it is straight
# Sections: height z, middle x and y, half the breadth, half the depth [m], exponent (2: an ellipse).
LEG = np.array([(1.02, 0.065, 0.000, 0.090, 0.098, 2.3),
                (0.90, 0.070, -0.010, 0.100, 0.114, 2.4),
                (0.82, 0.076, -0.010, 0.098, 0.110, 2.3),
                (0.76, 0.096, -0.002, 0.083, 0.092, 2.1),
                (0.66, 0.097, 0.000, 0.076, 0.082, 2.0),
                (0.48, 0.098, 0.000, 0.055, 0.060, 2.0),
                (0.36, 0.099, -0.012, 0.053, 0.058, 2.0),
                (0.12, 0.100, -0.010, 0.034, 0.040, 2.0)])
CAPS = 4  # rings of each rounded end
DEPTH = 0.03  # of the ends [m]


def section(stations, z):
    """Middle x and y, half breadth, half depth and exponent at a height: cubic between the stations."""
    table = stations[::-1]
    at, value = table[:, 0], table[:, 1:]
    slope = np.gradient(value, at, axis=0)
    i = np.clip(np.searchsorted(at, z) - 1, 0, len(at) - 2)
    h = at[i + 1] - at[i]
    u = (z - at[i]) / h
    chord = value[i + 1] - value[i]
    return (value[i] + u * chord
            + u * (1 - u) * ((1 - u) * (h * slope[i] - chord) - u * (h * slope[i + 1] - chord)))


def outline(stations, z, turn):
    """Points (x, y) of a section at these angles from its outer side (+x), over its front (+y)."""
    x, y, a, b, exponent = section(stations, z)
    along, across = (np.sign(v) * np.abs(v) ** (2 / exponent) for v in (np.cos(turn), np.sin(turn)))
    return np.stack([x + a * along, y + b * across], -1)


def evenly(points, count):
    """As many points of a closed line, the first one its first, at equal distances along it."""
    closed = np.concatenate([points, points[:1]])
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    at = length[-1] * np.arange(count) / count
    return np.stack([np.interp(at, length, closed[:, axis]) for axis in (0, 1)], -1)


def straight_leg(around, along):
    """Rings from the top down, the straight leg: their points (rings, around, 3), and the two poles [m]."""
    turn = 2 * np.pi * np.arange(DENSE) / DENSE
    heights = np.linspace(LEG[0, 0], LEG[-1, 0], along)
    rings = [np.pad(evenly(outline(LEG, z, turn), around), ((0, 0), (0, 1)), constant_values=z) for z in heights]
    bent = np.linspace(0, 0.5 * np.pi, CAPS + 1)[1:-1]

    def end(ring, z, up):
        middle = np.append(section(LEG, z)[:2], z)
        cap = [middle + np.cos(t) * (ring - middle) + [0, 0, up * DEPTH * np.sin(t)] for t in bent]
        return cap, middle + [0, 0, up * DEPTH]

    top, first = end(rings[0], heights[0], 1)
    bottom, last = end(rings[-1], heights[-1], -1)
    return np.array(top[::-1] + rings + bottom), np.array([first, last])


def bent_leg(rings, poles, angle):
    """All its vertices where the knee is bent by that angle [rad]: ring by ring, then the poles."""
    heights = np.concatenate([poles[:1, 2], rings[:, 0, 2], poles[1:, 2]])
    at, tangent = middle_line(KNEE - heights, angle, JOINT)  # down and back from the knee

    def placed(points, at, tangent):
        back = NEUTRAL - points[..., 1]
        down, behind = at[:, 0] - back * tangent[:, 1], at[:, 1] + back * tangent[:, 0]
        return np.stack([points[..., 0], NEUTRAL - behind, KNEE - down], -1)

    around = rings.shape[1]
    body = placed(rings.reshape(-1, 3), at[1:-1].repeat(around, 0), tangent[1:-1].repeat(around, 0))
    return np.concatenate([body, placed(poles, at[[0, -1]], tangent[[0, -1]])])


def angle_at(time, degrees):
    within = time - HANG
    return np.radians(degrees) * (smoothstep(within / BEND) - smoothstep((within - BEND - BETWEEN - HOLD) / BEND))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).parent, metavar="DIR")
    parser.add_argument("--around", type=int, default=40, help="vertices of a ring")
    parser.add_argument("--along", type=int, default=64, help="rings between the ends")
    parser.add_argument("--degrees", type=float, default=90)
    parser.add_argument("--fps", type=float, default=25)
    asked = parser.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    times = np.arange(np.ceil((HANG + 2 * BEND + BETWEEN + HOLD) * asked.fps - 1e-9) + 1) / asked.fps
    rings, poles = straight_leg(asked.around, asked.along)
    frames = [bent_leg(rings, poles, angle_at(time, asked.degrees)) for time in times]
    faces = triangles(len(rings), asked.around)[:, ::-1]  # sections run the other way round than those of the arm
    write_body(asked.out / "leg", "A right leg, the floor at z = 0, its front towards y [m]; made by make_leg.py.",
               times, frames, faces)


if __name__ == "__main__":
    main()
