"""Laws on arrays: the same numbers as the program's, closed forms, histories that are apart."""

import os
import tempfile
import unittest
import warnings

from support import hysteron_cloth, np, program

B1, B2, K0 = 3e-5, 1e-5, 50.0  # [N m], [N m], [1/m]
G, M0 = B1 - B2, (B1 - B2) * K0 / 2
ROUNDING = 1e-12


def fabric():
    return hysteron_cloth.Fabric("cotton-broad", b1=B1, b2=B2, k0=K0)


def exact(**parameters):
    """prandtl with a memory of every reversal of these tests."""
    return hysteron_cloth.Law("prandtl", fabric(), memory="stack", stack=16, **parameters)


def walk(law, curvatures, n=1):
    """Moments of n elements along the curvatures, and their state after them."""
    state = law.rest(n)
    return np.array([law.step(state, np.full(n, k)) for k in curvatures]), state


class WithAFabric(unittest.TestCase):
    def test_whose_sides_it_does_not_follow_is_warned_of(self):
        sided = hysteron_cloth.Fabric("cotton-broad", b1=B1, b2=B2, k0=K0, back_bending=2)
        with self.assertWarnsRegex(UserWarning, "law dahl bends both ways alike"):
            hysteron_cloth.Law("dahl", sided)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            hysteron_cloth.Law("prandtl", sided)
            hysteron_cloth.Law("dahl", fabric())


class OfTheProgram(unittest.TestCase):
    def test_every_law_gives_its_moments_and_losses(self):
        rows = np.concatenate([np.linspace(0, 120, 13), np.linspace(110, -90, 21), np.linspace(-80, 40, 13)])
        for name in hysteron_cloth.laws():
            options = {"prandtl": {"memory": "stack", "stack": 16}, "chapman": {"stops": 32}}.get(name, {})
            with self.subTest(law=name), tempfile.TemporaryDirectory() as folder:
                data, result = os.path.join(folder, "k.csv"), os.path.join(folder, "m.csv")
                np.savetxt(data, rows, header="curvature [1/m]", comments="")
                flags = [f"--param={key}={value}" for key, value in options.items()]
                program("law", "--law", name, "--b1", B1, "--b2", B2, "--k0", K0, "--in", data, "--out", result,
                        *flags)
                table = np.genfromtxt(result, delimiter=",", names=True, deletechars="")
                law = hysteron_cloth.Law(name, fabric(), **options)
                moments, state = walk(law, rows)
                scale = np.abs(table["moment_[N]"]).max()
                np.testing.assert_allclose(moments[:, 0], table["moment_[N]"], atol=ROUNDING * scale)
                np.testing.assert_allclose(law.dissipated(state)[0], table["dissipated_[J/m2]"][-1],
                                           atol=ROUNDING * scale * 120)


class ClosedForms(unittest.TestCase):
    def test_first_bending_follows_the_virgin_curve(self):
        k = np.linspace(1, 2 * K0, 20)
        moments, _ = walk(exact(), k)
        virgin = np.where(k < K0, B1 * k - G / (2 * K0) * k**2, M0 + B2 * k)
        np.testing.assert_allclose(moments[:, 0], virgin, rtol=ROUNDING)

    def test_a_cycle_of_full_slip_loses_the_area_of_its_loop(self):
        amplitude = 3 * K0
        law = exact()
        _, state = walk(law, [amplitude])
        before = law.dissipated(state)[0]
        for k in (-amplitude, amplitude):
            law.step(state, np.array([k]))
        area = 2 * (2 * M0 * K0 / 3 + M0 * (2 * amplitude - 2 * K0))
        self.assertAlmostEqual(law.dissipated(state)[0] - before, area, delta=ROUNDING * area)

    def test_what_is_let_go_keeps_the_curvature_of_no_moment(self):
        law = exact()
        _, state = walk(law, [3 * K0])
        residual = law.residual(state)
        self.assertGreater(residual[0], 0)
        self.assertAlmostEqual(law.trial(state, residual)[0], 0, delta=ROUNDING * M0)

    def test_the_tangent_is_the_slope_of_trials(self):
        law = exact()
        _, state = walk(law, [80, -30])
        k = np.array([-5.0])
        error = []
        for h in (1e-1, 5e-2):
            slope = (law.trial(state, k + h) - law.trial(state, k - h)) / (2 * h)
            error.append(abs(slope - law.tangent(state, k))[0])
        self.assertGreater(law.tangent(state, k)[0], B2)
        self.assertLess(max(error), 1e-9 * B1)  # the branch is a parabola: central differences are exact

    def test_a_cylinder_bends_by_the_scalar_law(self):
        scalar = hysteron_cloth.Law("prandtl", fabric(), stops=8)
        tensor = hysteron_cloth.Law("prandtl", fabric(), dimension=3, stops=8)
        one, three = scalar.rest(1), tensor.rest(1)
        for k in (70.0, -20.0, 35.0):
            along = tensor.step(three, np.array([[k, 0, 0]]))
            self.assertAlmostEqual(along[0, 0], scalar.step(one, np.array([k]))[0], delta=ROUNDING * M0)
            self.assertEqual(list(along[0, 1:]), [0, 0])


class Histories(unittest.TestCase):
    def test_of_elements_are_apart(self):
        law = exact()
        state = law.rest(2)
        law.step(state, np.array([100.0, 0]))
        back = law.step(state, np.array([0.0, 0]))
        self.assertLess(back[0], 0)
        self.assertEqual(back[1], 0)

    def test_a_copy_goes_on_by_itself_and_a_trial_changes_nothing(self):
        law = exact()
        _, state = walk(law, [100])
        copy = state.copy()
        tried = law.trial(state, np.array([20.0]))
        law.step(copy, np.array([-100.0]))
        self.assertEqual(law.step(state, np.array([20.0]))[0], tried[0])
        self.assertNotEqual(law.step(copy, np.array([20.0]))[0], tried[0])

    def test_moments_go_where_they_are_wanted(self):
        law, out = exact(), np.empty(1)
        self.assertIs(law.step(law.rest(1), np.array([10.0]), out=out), out)
        self.assertAlmostEqual(out[0], B1 * 10 - G / (2 * K0) * 100, delta=ROUNDING * M0)


class Refusals(unittest.TestCase):
    def test_carry_key_and_value(self):
        with self.assertRaises(hysteron_cloth.RequestError) as raised:
            hysteron_cloth.Law("prandtl", fabric(), stops=5)
        self.assertEqual((raised.exception.key, raised.exception.value), ("stops", "5"))
        with self.assertRaises(ValueError) as raised:
            hysteron_cloth.Fabric("cotton-broad", density=-1)
        self.assertEqual((raised.exception.key, raised.exception.value), ("fabric.density", "-1"))

    def test_name_what_is_near(self):
        with self.assertRaisesRegex(hysteron_cloth.Error, "prandtl"):
            hysteron_cloth.Law("prandl", fabric())
        with self.assertRaises(AttributeError):
            fabric().colour

    def test_are_none_of_another_name_for_a_fabric(self):
        renamed = fabric()
        renamed.name = "mine"
        self.assertEqual((renamed.name, renamed.b1), ("mine", B1))

    def test_curvatures_of_another_shape(self):
        with self.assertRaisesRegex(hysteron_cloth.Error, r"must be \(3,\)"):
            exact().step(exact().rest(3), np.zeros(2))


if __name__ == "__main__":
    unittest.main()
