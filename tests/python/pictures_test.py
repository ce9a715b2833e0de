"""Pictures as arrays, and how far they differ."""

import os
import tempfile
import unittest

from support import hysteron_cloth, np


def square(**keys):
    return hysteron_cloth.Scene(**{"cloth_length": 0.1, "triangles": 60, "threads": 1, **keys})


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.sim = hysteron_cloth.Simulation(square())
        try:
            cls.picture = hysteron_cloth.render(cls.sim, size=(96, 64))
        except hysteron_cloth.MachineError as failure:
            raise unittest.SkipTest(str(failure))

    def test_are_arrays_of_rows_from_the_top(self):
        self.assertEqual((self.picture.shape, self.picture.dtype), ((64, 96, 3), np.uint8))
        self.assertGreater(self.picture.std(), 0)

    def test_show_the_cloth_where_it_is(self):
        bounds = ((-0.05, -0.05, -0.3), (0.15, 0.15, 0.05))
        view = dict(size=(96, 64), bounds=bounds, look="silhouette", camera_direction=(0, -1, 0.4))
        sim = hysteron_cloth.Simulation(square())
        rows = []
        for _ in range(2):
            shown = hysteron_cloth.render(sim, **view)
            rows.append(np.nonzero((shown < 128).all(axis=2))[0].mean())
            sim.advance(8)
        self.assertGreater(rows[1], rows[0] + 5)  # it has fallen

    def test_show_a_body_of_triangles_from_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "wedge.obj")
            with open(file, "w", encoding="utf-8") as obj:
                obj.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
            body = {"kind": "mesh", "file": file, "unit": "centimetre", "center": (0.05, 0.05, -0.05)}
            sim = hysteron_cloth.Simulation(square(obstacle=[body]))
        view = dict(size=(96, 64), bounds=((0, 0, -0.06), (0.1, 0.1, 0.01)), camera_direction=(0, -1, 0.2))
        shown, without = (hysteron_cloth.render(s, **view) for s in (sim, hysteron_cloth.Simulation(square())))
        self.assertGreater((np.abs(shown.astype(int) - without) > 30).sum(), 30)

    def test_without_cloth_are_failures(self):
        with self.assertRaisesRegex(hysteron_cloth.RunError, "shows no cloth"):
            hysteron_cloth.render(self.sim, size=(32, 32), bounds=((5, 5, 5), (6, 6, 6)))

    def test_may_be_transparent(self):
        self.assertEqual(hysteron_cloth.render(self.sim, size=(32, 32), background="transparent").shape, (32, 32, 4))

    def test_of_another_look_are_refused_by_name(self):
        with self.assertRaises(hysteron_cloth.RequestError) as raised:
            hysteron_cloth.render(self.sim, look="curvatur")
        self.assertEqual((raised.exception.key, raised.exception.value), ("look", "curvatur"))


class Differences(unittest.TestCase):
    def test_of_a_step_in_one_channel_are_the_formulas(self):
        a = np.full((20, 30, 3), 100, np.uint8)
        b = a.copy()
        b[..., 0] += 10
        found = hysteron_cloth.diff(a, b)
        self.assertAlmostEqual(found["mean_abs"], 10 / 3)
        self.assertAlmostEqual(found["rmse"], 10 / np.sqrt(3))
        self.assertAlmostEqual(found["psnr_db"], 20 * np.log10(255 * np.sqrt(3) / 10))
        self.assertEqual(found["pixels_over_8_percent"], 100)
        self.assertEqual(found["heat"].shape, (20, 30, 3))

    def test_of_pictures_that_are_none_are_refused(self):
        with self.assertRaises(hysteron_cloth.RequestError):
            hysteron_cloth.diff(np.zeros((4, 4, 3)), np.zeros((4, 4, 3)))
        with self.assertRaisesRegex(hysteron_cloth.RequestError, "nowhere.png"):
            hysteron_cloth.diff(os.path.join(tempfile.gettempdir(), "nowhere.png"), np.zeros((4, 4, 3), np.uint8))


if __name__ == "__main__":
    unittest.main()
