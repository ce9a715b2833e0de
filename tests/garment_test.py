"""The shipped bodies and the pattern are what their scripts write, a body and a garment, and begin to move in balance;
so do they from files as other programs write them, by the scene of docs/own-scenes.md.

    garment_test.py build/hysteron

Exit code 77 without numpy.
"""
import collections
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError:
    sys.exit(77)

ROOT = Path(__file__).resolve().parent.parent
ASSETS = ROOT / "assets"
PROGRAM = sys.argv.pop()
ROUNDING = 2e-5  # of six digits, and of another version's sines [m]
LARGEST_EASE = 0.003  # of a seam: how much longer one side is than the other
COARSE = ("--down", "22", "--front", "6", "--back", "7")  # of the pattern
SMALLEST_GAP = 0.006  # between the cloth at the start and the leg [m]


def script(name, out, *options):
    """Runs a script of the assets and returns its output."""
    command = [sys.executable, ASSETS / name, "--out", out, *options]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class Obj:
    """Vertices, texture coordinates, and the numbers of both at the corners of triangles."""

    def __init__(self, file):
        self.vertex, self.texture, corners = [], [], []
        for words in (line.split() for line in Path(file).read_text("ascii").splitlines()):
            if words[0] in ("v", "vt"):
                (self.vertex if words[0] == "v" else self.texture).append([float(word) for word in words[1:]])
            elif words[0] == "f":
                corners.append([[int(number) - 1 for number in word.split("/")] for word in words[1:]])
        self.vertex, self.texture = np.array(self.vertex), np.array(self.texture)
        self.face, self.flat = np.array(corners)[..., 0], np.array(corners)[..., -1]

    def sides(self):
        """Returns for each pair of vertices, the smaller number first, the triangles' sides between them: vertices in
        the order of the triangle, texture coordinates in that of the pair."""
        found = collections.defaultdict(list)
        for face, flat in zip(self.face, self.flat):
            for k in range(3):
                pair, at = (face[k], face[(k + 1) % 3]), (flat[k], flat[(k + 1) % 3])
                found[tuple(sorted(pair))].append((pair, at if pair[0] < pair[1] else at[::-1]))
        return found


def mdd(file):
    """Returns times, and points of all frames."""
    data = Path(file).read_bytes()
    frames, points = np.frombuffer(data, ">i4", 2)
    return (np.frombuffer(data, ">f4", frames, 8).astype(float),
            np.frombuffer(data, ">f4", 3 * frames * points, 8 + 4 * frames).astype(float).reshape(frames, points, 3))


def normals(points, faces):
    """Returns normals of triangles, twice as long as their area."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def volume(points, faces):
    a, b, c = (points[faces[:, k]] for k in range(3))
    return np.einsum("fi,fi->", np.cross(a, b), c) / 6


class Garment(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def assert_same(self, name):
        shipped, written = Obj(next(ASSETS.glob(f"*/{name}"))), Obj(self.folder / name)
        for one, other in ((shipped.face, written.face), (shipped.flat, written.flat)):
            self.assertTrue(np.array_equal(one, other), name)
        for one, other in ((shipped.vertex, written.vertex), (shipped.texture, written.texture)):
            np.testing.assert_allclose(one, other, atol=ROUNDING, err_msg=name)

    def test_files_are_what_the_scripts_write(self):
        for name in ("make_arm.py", "make_leg.py"):
            script(f"bodies/{name}", self.folder)
        script("scenes/make_trousers.py", self.folder)
        for name in ("arm.obj", "leg.obj", "trousers.obj"):
            self.assert_same(name)
        for name in ("arm.mdd", "leg.mdd"):
            for one, other in zip(mdd(ASSETS / "bodies" / name), mdd(self.folder / name)):
                np.testing.assert_allclose(one, other, atol=ROUNDING, err_msg=name)

    def test_bodies_are_closed_and_face_outward_in_every_frame(self):
        for name in ("arm", "leg"):
            body = Obj(ASSETS / f"bodies/{name}.obj")
            for sides in body.sides().values():
                self.assertEqual(len(sides), 2, name)
                self.assertEqual(sides[0][0], sides[1][0][::-1], name)
            _, frames = mdd(ASSETS / f"bodies/{name}.mdd")
            np.testing.assert_allclose(frames[0], body.vertex, atol=ROUNDING, err_msg=name)
            first = volume(frames[0], body.face)
            self.assertGreater(first, 0, name)
            for points in frames:  # flesh is not squeezed
                self.assertAlmostEqual(volume(points, body.face) / first, 1, delta=0.05, msg=name)

    def test_knee_bends_by_a_right_angle_and_straightens(self):
        body = Obj(ASSETS / "bodies/leg.obj")
        times, frames = mdd(ASSETS / "bodies/leg.mdd")
        thigh, ankle = body.vertex[:, 2] > 0.7, body.vertex[:, 2] < 0.1
        np.testing.assert_allclose(frames[:, thigh], np.broadcast_to(body.vertex[thigh], frames[:, thigh].shape),
                                   atol=ROUNDING)
        np.testing.assert_allclose(frames[-1], body.vertex, atol=ROUNDING)
        bent = frames[np.searchsorted(times, 1.8)]
        up = np.array([0, 0, 1])

        def axis(points):  # of the ankle's end, which is flat
            spread = points[ankle] - points[ankle].mean(0)
            return np.linalg.svd(spread)[2][2]

        self.assertAlmostEqual(abs(axis(frames[0]) @ up), 1, delta=0.01)
        self.assertAlmostEqual(abs(axis(bent) @ up), 0, delta=0.01)
        self.assertLess(bent[ankle, 1].mean(), -0.3, "back, not to the front")

    def test_panels_are_sewn_along_two_seams_with_little_ease(self):
        pattern = Obj(ASSETS / "scenes/trousers.obj")
        seams = collections.defaultdict(lambda: np.zeros(2))
        for pair, sides in pattern.sides().items():
            self.assertLessEqual(len(sides), 2)
            if len(sides) == 2 and tuple(sides[0][1]) != tuple(sides[1][1]):
                ends = np.array([[pattern.texture[i] for i in at] for _, at in sides])
                is_outseam = pattern.vertex[pair[0], 0] > 0.1
                seams[is_outseam] += np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        self.assertEqual(len(seams), 2)
        for side, height in ((True, 0.865), (False, 0.635)):  # from the hem to the waist, and to the crotch
            one, other = seams[side]
            self.assertLess(abs(one / other - 1), LARGEST_EASE)
            self.assertAlmostEqual(one, height, delta=0.02)

    def test_panels_are_flat_cloth_seen_from_outside_that_the_start_hardly_stretches(self):
        pattern = Obj(ASSETS / "scenes/trousers.obj")
        flat = normals(np.pad(pattern.texture, ((0, 0), (0, 1))), pattern.flat)[:, 2]
        self.assertGreater(flat.min(), 0)
        normal = normals(pattern.vertex, pattern.face)
        self.assertAlmostEqual(np.linalg.norm(normal, axis=1).sum() / flat.sum(), 1, delta=0.01)
        middle = pattern.vertex[pattern.face].mean(1) - [0.09, 0, 0]
        self.assertGreater(np.einsum("fi,fi->f", normal[:, :2], middle[:, :2]).min(), 0)
        strain = []
        for pair, sides in pattern.sides().items():
            worn = np.linalg.norm(pattern.vertex[pair[1]] - pattern.vertex[pair[0]])
            strain += [worn / np.linalg.norm(pattern.texture[at[1]] - pattern.texture[at[0]]) - 1 for _, at in sides]
        self.assertLess(np.sqrt(np.mean(np.square(strain))), 0.01)
        self.assertLess(np.max(np.abs(strain)), 0.12)

    def test_trousers_leave_the_leg_room(self):
        leg, cloth = Obj(ASSETS / "bodies/leg.obj"), Obj(ASSETS / "scenes/trousers.obj")
        normal = normals(leg.vertex, leg.face)
        middle = leg.vertex[leg.face].mean(1)
        for points in np.array_split(cloth.vertex, 20):
            away = points[:, None] - middle
            nearest = np.linalg.norm(away, axis=2).argmin(1)
            height = np.einsum("pi,pi->p", away[np.arange(len(points)), nearest],
                               normal[nearest] / np.linalg.norm(normal[nearest], axis=1)[:, None])
            self.assertGreater(height.min(), SMALLEST_GAP)

    def run_of(self, command, *options):
        """Its metrics, and what it warns of."""
        out = self.folder / "run"
        done = subprocess.run([PROGRAM, *command, *options, "--no-images", "--device", "cpu", "--threads", "1", "--out",
                               out], check=True, capture_output=True, text=True)
        return json.loads((out / "manifest.json").read_text("utf-8"))["metrics"], done.stderr

    def assert_balanced(self, metrics):
        for name in ("intersections", "unbalanced_steps_count", "deep_contact_steps_count"):
            self.assertEqual(metrics[name], 0, name)

    def test_scene_of_the_documentation_reads_centimetres_with_y_up(self):
        def turned(points):
            return 100 * np.stack([points[..., 0], points[..., 2], -points[..., 1]], -1)

        def rewrite(name, source, texture=1):
            lines = []
            for line in source.read_text("ascii").splitlines():
                kind, *words = line.split()
                if kind == "v":
                    words = turned(np.array(words, float))
                elif kind == "vt":
                    words = texture * np.array(words, float)
                lines.append(" ".join([kind, *map(str, words)]))
            (self.folder / name).write_text("\n".join(lines) + "\n", "ascii")

        script("scenes/make_trousers.py", self.folder, *COARSE)
        rewrite("garment.obj", self.folder / "trousers.obj", 100)
        rewrite("body.obj", ASSETS / "bodies/leg.obj")
        times, frames = mdd(ASSETS / "bodies/leg.mdd")
        (self.folder / "body.mdd").write_bytes(b"".join([
            np.array(frames.shape[:2], ">i4").tobytes(), times.astype(">f4").tobytes(),
            turned(frames).astype(">f4").tobytes()]))
        page = (ROOT / "docs/own-scenes.md").read_text("utf-8")
        scene = re.search(r"## Your garment on your body\n.*?```toml\n(.*?)```", page, re.DOTALL)[1]
        (self.folder / "mine.toml").write_text(scene, "utf-8")
        metrics, said = self.run_of(["run", self.folder / "mine.toml"], "--seconds", "0.02")
        self.assert_balanced(metrics)
        self.assertNotIn("mesh ", said, "nothing is doubtful about the files")

    def test_coarse_trousers_begin_in_balance_and_free_of_crossings(self):
        said = script("scenes/make_trousers.py", self.folder, *COARSE)
        self.assertIn("572 triangles", said)
        metrics, _ = self.run_of(["crumple", "--scene", "trousers"], "--cloth.file", self.folder / "trousers.obj",
                                 "--cloth.subdivisions", "0", "--seconds", "0.04")
        self.assert_balanced(metrics)


if __name__ == "__main__":
    unittest.main()
