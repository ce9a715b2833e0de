"""A loop that a law has made gives its fabric back."""

import os
import tempfile
import unittest
import warnings

from support import hysteron_cloth, np

B1, B2, K0 = 3e-5, 1e-5, 60.0  # [N m], [N m], [1/m]


def loop(noise=0.0):
    """Curvatures [1/m] and moments [N] of two cycles."""
    up, around = np.linspace(0, 200, 30), np.linspace(200, -200, 60)
    k = np.concatenate([up, around[1:], around[::-1][1:]])
    law = hysteron_cloth.Law("prandtl", hysteron_cloth.Fabric(b1=B1, b2=B2, k0=K0), memory="stack", stack=16)
    state = law.rest(1)
    m = np.array([law.step(state, np.array([x]))[0] for x in k])
    return k, m + noise * np.abs(m).max() * np.random.default_rng(1).standard_normal(len(m))


class Loop(unittest.TestCase):
    def test_gives_back_the_fabric_that_made_it(self):
        found = hysteron_cloth.fit(*loop())
        for name, value in (("b1", B1), ("b2", B2), ("k0", K0)):
            self.assertAlmostEqual(getattr(found, name), value, delta=1e-3 * value)
        self.assertEqual(found.undetermined, [])
        self.assertLess(found.residual_rms, 1e-3 * np.abs(loop()[1]).max())

    def test_with_noise_is_within_its_standard_errors(self):
        found = hysteron_cloth.fit(*loop(noise=0.01))
        for name, value in (("b1", B1), ("b2", B2), ("k0", K0)):
            self.assertLess(abs(getattr(found, name) - value), 4 * getattr(found, name + "_stderr"))

    def test_in_units_of_kes_is_the_same(self):
        k, m = loop()
        found = hysteron_cloth.fit(k / 100, m / 9.80665e-3, units="kes")
        self.assertAlmostEqual(found.b2, B2, delta=1e-3 * B2)

    def test_makes_a_fabric_that_can_be_draped_and_written(self):
        found = hysteron_cloth.fit(*loop())
        fabric = found.fabric("mine", density=0.12, thickness=4e-4)
        self.assertEqual((fabric.b1, fabric.density), (found.b1, 0.12))
        self.assertEqual(fabric.provenance()["b1"]["confidence"], "fitted")
        hysteron_cloth.Simulation(hysteron_cloth.Scene(fabric=fabric, triangles=20)).advance()
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "mine.toml")
            found.write(file, "mine", density=0.12, thickness=4e-4)
            self.assertAlmostEqual(hysteron_cloth.Fabric(file).k0, found.k0, delta=1e-6 * K0)

    def test_of_rows_without_time_and_of_another_law_is_warned_of(self):
        with self.assertWarnsRegex(UserWarning, "gong takes time"):
            hysteron_cloth.fit(*loop(), law="gong")
        with self.assertWarnsRegex(UserWarning, "linear is not near these data"):
            hysteron_cloth.fit(*loop(), law="linear")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            hysteron_cloth.fit(*loop())

    def test_that_is_none_is_refused(self):
        with self.assertRaisesRegex(hysteron_cloth.RequestError, "rows"):
            hysteron_cloth.fit([0, 1], [0, 1])
        with self.assertRaises(hysteron_cloth.RequestError) as raised:
            hysteron_cloth.fit(loop()[0], loop()[1][:-1])
        self.assertEqual(raised.exception.key, "moment")


if __name__ == "__main__":
    unittest.main()
