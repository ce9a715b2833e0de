"""A scene exported as USD and as glTF, against the meshes of the same run: `animation.py HYSTERON FOLDER READER`.

READER: `own` reads both files by what their formats say, with Python alone; `usd` has OpenUSD read cloth.usda (package
usd-core of PyPI), `gltf` has pygltflib and trimesh read cloth.glb.  Exit code 77 without a reader's packages.  Where they
are in a virtual environment, ctest finds them by PYTHONPATH=VENV/lib/python3.*/site-packages.
"""
import array
import csv
import json
import math
import re
import shutil
import struct
import subprocess
import sys
from pathlib import Path

PROGRAM, FOLDER, READER = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
FPS, SECONDS, COMES, GOES = 30, 0.2, 0.05, 0.15
SCENE = f"""
triangles = 200
seconds = {SECONDS}
step = 1e-3
[cloth]
shape = "strip"
length = 0.1
width = 0.08
position = [0, 0, 0.01]
[[obstacle]]
kind = "sphere"
center = [0.05, 0.04, -0.05]
radius = 0.04
motion-center = [0.05, 0.04, -0.05]
motion-axis = [1, 0, 0]
keys = [{{time = 0}}, {{time = {SECONDS}, position = [0, 0, 0.03], angle = 90}}]
[[obstacle]]
kind = "box"
center = [0.3, 0, 0]
size = [0.02, 0.03, 0.04]
from = {COMES}
until = {GOES}
[[obstacle]]
center = [0, 0, -0.1]
"""


def exported(form):
    """The run's folder `mesh`."""
    out = FOLDER / form
    run = subprocess.run([PROGRAM, "run", str(FOLDER / "scene.toml"), "--fps", str(FPS), "--device", "cpu", "--threads",
                          "1", "--no-images", "--quiet", "--export", form, "--out", str(out)], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return out / "mesh"


def ply(file):
    """Positions, 3 doubles a vertex, and triangles."""
    head, body = file.read_bytes().split(b"end_header\n", 1)
    vertices, faces = (int(re.search(rb"element %s (\d+)" % name, head)[1]) for name in (b"vertex", b"face"))
    doubles = head.count(b"property double")
    numbers = struct.unpack_from(f"<{doubles * vertices}d", body)
    at = 8 * doubles * vertices
    corners = [struct.unpack_from("<iii", body, at + 13 * f + 1) for f in range(faces)]
    return [numbers[doubles * v:doubles * v + 3] for v in range(vertices)], [list(c) for c in corners]


def in_single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


class Run:
    """Reads what the same run has as plain meshes."""

    def __init__(self):
        self.frames = [ply(file) for file in sorted(exported("ply").glob("*.ply"))]
        with open(FOLDER / "ply" / "metrics.csv", encoding="utf-8") as rows:
            self.times = [float(row["time [s]"]) for row in csv.DictReader(rows)]
        assert len(self.times) == len(self.frames) == 7, "7 instants in a fifth of a second"
        self.faces = self.frames[0][1]
        fall = self.frames[0][0][0][2] - min(x[2] for x in self.frames[-1][0])
        assert fall > 0.01, f"the cloth has fallen by {fall} m"

    def check_points(self, frame, points, ulps):
        """Positions as those of this frame, by so many roundings to single precision of their size."""
        wanted = self.frames[frame][0]
        assert len(points) == len(wanted), "vertices"
        largest = max(abs(c) for x in wanted for c in x)
        worst = max(abs(a - b) for x, y in zip(points, wanted) for a, b in zip(x, y))
        assert worst <= ulps * largest * 2**-24, f"frame {frame}: {worst} m beside"


def near(a, b, tolerance=1e-5):
    return all(abs(x - y) <= tolerance for x, y in zip(a, b, strict=True))


def read_usd(run, folder):
    text = (folder / "cloth.usda").read_text("utf-8")
    assert text.startswith("#usda 1.0\n") and text.count("{") == text.count("}") and text.count("(") == text.count(")")
    for setting in ("metersPerUnit = 1", 'upAxis = "Z"', f"timeCodesPerSecond = {FPS}", f"framesPerSecond = {FPS}",
                    "startTimeCode = 0", "endTimeCode = 6"):
        assert f"    {setting}\n" in text, setting
    cloth = text[text.index('def Mesh "cloth"'):text.index('def Mesh "sphere_0"')]
    for name in ("points", "normals", "extent"):
        block = re.search(rf"{name}\.timeSamples = {{\n(.*?)\n +}}\n", cloth, re.S)[1].splitlines()
        codes = [float(line.split(":")[0]) for line in block]
        assert codes == [round(1e6 * t * FPS) / 1e6 for t in run.times], f"time codes of {name}"
        if name == "points":
            for frame, line in enumerate(block):
                numbers = [in_single(float(x)) for x in re.findall(r"[-+.\de]+", line.split(":")[1])]
                run.check_points(frame, [numbers[i:i + 3] for i in range(0, len(numbers), 3)], 1)
    for prim in ('Mesh "sphere_0"', 'Mesh "box_1"', 'Mesh "ground_2"', 'Camera "camera"', 'DistantLight "key_light"'):
        assert text.count(f"def {prim}") == 1, prim


def read_glb(run, folder):
    data = (folder / "cloth.glb").read_bytes()
    magic, version, length, json_length, json_type = struct.unpack_from("<4sIII4s", data)
    assert (magic, version, length, json_type) == (b"glTF", 2, len(data), b"JSON")
    gltf = json.loads(data[20:20 + json_length])
    assert struct.unpack_from("<I4s", data, 20 + json_length) == (len(data) - 28 - json_length, b"BIN\0")

    def numbers(accessor):
        of = gltf["accessors"][accessor]
        view = gltf["bufferViews"][of["bufferView"]]
        begin = 28 + json_length + view["byteOffset"]
        assert begin % 4 == 0, "alignment"
        values = array.array({5125: "I", 5126: "f"}[of["componentType"]], data[begin:begin + view["byteLength"]])
        assert len(values) == of["count"] * {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[of["type"]], "count"
        return values

    nodes = {node["name"]: node for node in gltf["nodes"]}
    assert {"run", "cloth", "sphere_0", "box_1", "box_1_seen", "ground_2", "camera"} == set(nodes)
    assert near(nodes["run"]["rotation"], (-math.sqrt(0.5), 0, 0, math.sqrt(0.5))), "y up"
    assert gltf["cameras"][0]["type"] == "perspective"
    primitive = gltf["meshes"][nodes["cloth"]["mesh"]]["primitives"][0]
    assert list(numbers(primitive["indices"])) == [corner for face in run.faces for corner in face], "triangles"
    assert set(primitive["attributes"]) == {"POSITION", "NORMAL", "TEXCOORD_0"}
    channels = {(gltf["nodes"][channel["target"]["node"]]["name"], channel["target"]["path"]):
                gltf["animations"][0]["samplers"][channel["sampler"]] for channel in gltf["animations"][0]["channels"]}
    assert set(channels) == {("cloth", "weights"), ("sphere_0", "translation"), ("sphere_0", "rotation"),
                             ("box_1_seen", "scale")}
    weights = channels["cloth", "weights"]
    assert list(numbers(weights["input"])) == [in_single(t) for t in run.times] and weights["interpolation"] == "LINEAR"
    base, targets = numbers(primitive["attributes"]["POSITION"]), [numbers(t["POSITION"]) for t in primitive["targets"]]
    for frame in range(len(run.times)):
        row = numbers(weights["output"])[frame * len(targets):(frame + 1) * len(targets)]
        at = [x + sum(w * change[i] for w, change in zip(row, targets)) for i, x in enumerate(base)]
        run.check_points(frame, [at[i:i + 3] for i in range(0, len(at), 3)], 4)
    seen = numbers(channels["box_1_seen", "scale"]["output"])[::3]
    assert list(seen) == [float(COMES <= t < GOES) for t in run.times], list(seen)


def read_by_openusd(run, folder):
    from pxr import Gf, Usd, UsdGeom, UsdLux, UsdShade
    stage = Usd.Stage.Open(str(folder / "cloth.usda"))
    assert stage.GetDefaultPrim().GetPath() == "/run"
    assert UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z and UsdGeom.GetStageMetersPerUnit(stage) == 1
    assert stage.GetTimeCodesPerSecond() == stage.GetFramesPerSecond() == FPS
    assert stage.GetStartTimeCode() == 0 and stage.GetEndTimeCode() == 6
    mesh = UsdGeom.Mesh.Get(stage, "/run/cloth")
    codes = mesh.GetPointsAttr().GetTimeSamples()
    assert len(codes) == len(run.times) and near(codes, [t * FPS for t in run.times])
    assert mesh.GetNormalsAttr().GetTimeSamples() == mesh.GetExtentAttr().GetTimeSamples() == codes
    assert mesh.GetNormalsInterpolation() == "vertex" and mesh.GetDoubleSidedAttr().Get()
    assert mesh.GetSubdivisionSchemeAttr().Get() == "none"
    assert list(mesh.GetFaceVertexIndicesAttr().Get()) == [corner for face in run.faces for corner in face]
    assert UsdGeom.Mesh.ValidateTopology(mesh.GetFaceVertexIndicesAttr().Get(), mesh.GetFaceVertexCountsAttr().Get(),
                                         len(run.frames[0][0]))
    for frame, code in enumerate(codes):
        points = mesh.GetPointsAttr().Get(code)
        run.check_points(frame, points, 1)
        assert UsdGeom.PointBased.ComputeExtent(points) == mesh.GetExtentAttr().Get(code)
        assert all(abs(n.GetLength() - 1) < 1e-4 for n in mesh.GetNormalsAttr().Get(code))
    st = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st")
    assert st.GetInterpolation() == "vertex" and near([max(c) for c in zip(*st.Get())], (0.1, 0.08)), "metres"
    ball, box = (UsdGeom.Mesh.Get(stage, f"/run/{name}") for name in ("sphere_0", "box_1"))
    axis = ball.ComputeLocalToWorldTransform(6).TransformDir(Gf.Vec3d(0, 0, 1))
    assert near(axis, (0, -1, 0)), "a quarter turn about x"
    assert near(ball.ComputeLocalToWorldTransform(6).ExtractTranslation(), (0.05, 0.04, -0.02))
    for code, shown in ((0, False), (COMES * FPS, True), (GOES * FPS, False)):
        assert (box.ComputeVisibility(code) != UsdGeom.Tokens.invisible) == shown, code
    assert UsdGeom.Mesh.Get(stage, "/run/ground_2")
    camera = UsdGeom.Camera.Get(stage, "/run/camera").GetCamera(0)
    with open(FOLDER / "usd" / "manifest.json", encoding="utf-8") as manifest:
        fov = json.load(manifest)["options"]["camera"]["fov"]
    assert abs(camera.GetFieldOfView(Gf.Camera.FOVVertical) - fov) < 1e-3
    middle = UsdGeom.BBoxCache(0, ["default"]).ComputeWorldBound(mesh.GetPrim()).ComputeCentroid()
    assert camera.frustum.Intersects(Gf.Vec3d(middle)), "the cloth is in the picture"
    assert UsdLux.DistantLight.Get(stage, "/run/key_light") and UsdLux.DomeLight.Get(stage, "/run/sky")
    assert UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()[0].GetPath() == "/run/materials/cloth"


def read_by_gltf_libraries(run, folder):
    import numpy
    import pygltflib
    import trimesh
    gltf = pygltflib.GLTF2().load(str(folder / "cloth.glb"))
    blob = gltf.binary_blob()

    def numbers(accessor):
        of = gltf.accessors[accessor]
        view = gltf.bufferViews[of.bufferView]
        return numpy.frombuffer(blob, "<f4", view.byteLength // 4, view.byteOffset).reshape(of.count, -1)

    cloth = next(mesh for mesh in gltf.meshes if mesh.name == "cloth").primitives[0]
    assert len(cloth.targets) == len(run.times) - 1
    for frame in range(len(run.times)):
        at = numbers(cloth.attributes.POSITION).astype(float)
        if frame:
            at = at + numbers(cloth.targets[frame - 1]["POSITION"])
        run.check_points(frame, at, 4)
    assert gltf.cameras[0].type == "perspective" and len(gltf.animations[0].channels) == 4
    scene = trimesh.load(str(folder / "cloth.glb"), force="scene", process=False)
    placed, name = scene.graph.get("cloth")
    vertices = trimesh.transform_points(scene.geometry[name].vertices, placed)
    run.check_points(0, [(x, -z, y) for x, y, z in vertices], 8)
    assert {"sphere_0", "ground_2"} <= set(scene.graph.nodes_geometry)


def main():
    if READER == "usd":
        try:
            import pxr  # noqa: F401
        except ImportError:
            print("usd-core is not installed")
            return 77
    if READER == "gltf":
        try:
            import pygltflib, trimesh  # noqa: F401, E401
        except ImportError as lacking:
            print(f"{lacking.name} is not installed")
            return 77
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    (FOLDER / "scene.toml").write_text(SCENE, "utf-8")
    run = Run()
    for form, reader in {"own": [("usd", read_usd), ("glb", read_glb)], "usd": [("usd", read_by_openusd)],
                         "gltf": [("glb", read_by_gltf_libraries)]}[READER]:
        folder = exported(form)
        assert sorted(file.name for file in folder.iterdir()) == [{"usd": "cloth.usda", "glb": "cloth.glb"}[form]]
        reader(run, folder)
        print(f"{len(run.times)} instants of --export {form} read")
    return 0


sys.exit(main())
