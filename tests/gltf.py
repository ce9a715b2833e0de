"""A swing exported as one animated glTF file, against the meshes of the same run: `gltf.py HYSTERON FOLDER`."""
import array
import csv
import json
import shutil
import struct
import subprocess
import sys
from pathlib import Path

program, folder = sys.argv[1], Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)
for form in "gltf", "obj":
    subprocess.run([program, "swing", "--quick", "--seconds", "0.2", "--device", "cpu", "--threads", "1", "--no-images",
                    "--quiet", "--export", form, "--out", str(folder / form)], check=True, stdout=subprocess.DEVNULL)

data = (folder / "gltf" / "mesh" / "cloth.glb").read_bytes()
magic, version, length, json_length, json_type = struct.unpack_from("<4sIII4s", data)
assert (magic, version, length, json_type) == (b"glTF", 2, len(data), b"JSON")
gltf = json.loads(data[20:20 + json_length])
assert struct.unpack_from("<I4s", data, 20 + json_length)[1] == b"BIN\0"


def numbers(accessor):
    of = gltf["accessors"][accessor]
    view = gltf["bufferViews"][of["bufferView"]]
    begin = 28 + json_length + view["byteOffset"]
    assert begin % 4 == 0, "alignment"
    return array.array({5125: "I", 5126: "f"}[of["componentType"]], data[begin:begin + view["byteLength"]])


obj = sorted((folder / "obj" / "mesh").glob("*.obj"))
lines = [line.split() for line in obj[-1].read_text().splitlines()]
expected = [[float(x) for x in line[1:4]] for line in lines if line[0] == "v"]
faces = [int(corner.split("/")[0]) - 1 for line in lines if line[0] == "f" for corner in line[1:]]
primitive = gltf["meshes"][0]["primitives"][0]
assert list(numbers(primitive["indices"])) == faces, "triangles"

sampler = gltf["animations"][0]["samplers"][0]
with open(folder / "gltf" / "metrics.csv") as file:
    times = [struct.unpack("f", struct.pack("f", float(row["time [s]"])))[0] for row in csv.DictReader(file)]
assert list(numbers(sampler["input"])) == times and len(times) == len(obj) > 3, "times"
weights = numbers(sampler["output"])[-(len(times) - 1):]
assert list(weights) == [0] * (len(times) - 2) + [1], "the last target alone"

base, moved = numbers(primitive["attributes"]["POSITION"]), numbers(primitive["targets"][-1]["POSITION"])
assert len(base) == len(moved) == 3 * len(expected), "vertices"
worst = 0
for v, (x, y, z) in enumerate(expected):
    for k, wanted in enumerate((x, z, -y)):
        worst = max(worst, abs(base[3 * v + k] + moved[3 * v + k] - wanted))
largest = max(abs(c) for x in expected for c in x)
assert worst <= 2 * 2**-24 * 2 * largest, worst  # two roundings to single precision of at most twice the size
assert min(moved[1::3]) < -0.01, "the strip has fallen"
print(f"{len(times)} instants, positions within {worst:.1e} m")
