#!/usr/bin/env python3
"""rms.py REFERENCE RUN...: how far the last meshes of runs on one mesh are from those of the reference.

The folders are of `hysteron swing --export ply`. Prints a JSON list: root mean square distance of the vertices [mm],
and the time of the solver for a millisecond of the simulation [ms].
"""
import json
import math
import pathlib
import struct
import sys


def vertices(folder):
    data = max(pathlib.Path(folder, "mesh").glob("*.ply")).read_bytes()
    body = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:body].decode().splitlines()
    count = int(next(line for line in lines if line.startswith("element vertex")).split()[2])
    of_vertex = lines[: next(i for i, line in enumerate(lines) if line.startswith("element face"))]
    numbers = "".join(line.split()[1][0] for line in of_vertex if line.startswith("property"))  # d or f
    return [number[:3] for number in struct.iter_unpack("<" + numbers, data[body : body + count * struct.calcsize("<" + numbers)])]


def row(folder, reference):
    manifest = json.loads(pathlib.Path(folder, "manifest.json").read_text())
    square = sum((a - b) ** 2 for p, q in zip(vertices(folder), reference) for a, b in zip(p, q))
    return {
        "integrator": manifest["scene"]["integrator"],
        "triangles": manifest["scene"]["triangles"],
        "rms_mm": 1e3 * math.sqrt(square / len(reference)),
        "steps": manifest["steps"],
        "ms_per_simulated_ms": manifest["wall_seconds"]["solve"] / manifest["scene"]["seconds"],
    }


reference = vertices(sys.argv[1])
print(json.dumps([row(folder, reference) for folder in sys.argv[2:]], indent=1))
