"""Scenes and simulations: the program's bits, arrays that are the simulation's memory, hands in a loop's control."""

import gc
import json
import os
import signal
import tempfile
import threading
import unittest

from support import hysteron_cloth, np, program

SCENE = """
seconds = 0.05
step = 0.005
integrator = "{integrator}"
mesh = "random"
triangles = 120
precision = "{precision}"
threads = 1
[cloth]
shape = "strip"
length = 0.09
width = 0.03
[fabric]
name = "wool-tropical"
damping = 1e-5
[[pin]]
low = [-1, -1, -1]
high = [0.01, 1, 1]
"""


def strip(**keys):
    """A strip that is held at one end, of a hundred triangles."""
    held = {"low": (-1, -1, -1), "high": (0.01, 1, 1)}
    return hysteron_cloth.Scene(**{"cloth_shape": "strip", "cloth_length": 0.09, "cloth_width": 0.03, "triangles": 100,
                                   "step": 0.005, "threads": 1, "pin": [held], **keys})


class Bits(unittest.TestCase):
    def test_are_the_programs(self):
        for integrator, precision in (("bdf2", "double"), ("semi-implicit", "double"), ("implicit", "float")):
            with self.subTest(integrator=integrator), tempfile.TemporaryDirectory() as folder:
                file, out = os.path.join(folder, "strip.toml"), os.path.join(folder, "out")
                with open(file, "w") as text:
                    text.write(SCENE.format(integrator=integrator, precision=precision))
                program("swing", "--scene", file, "--out", out, "--no-images", "--quiet", "--fps", 60)
                with open(os.path.join(out, "manifest.json")) as manifest:
                    run = json.load(manifest)
                sim = hysteron_cloth.Simulation(hysteron_cloth.Scene(file))
                while sim.steps < run["steps"]:
                    sim.advance()
                self.assertGreater(sim.steps, 5)
                self.assertEqual(sim.state_hash, run["state_hash"])
                self.assertEqual(sim.ledger["bending_friction"], run["energy"]["bending_friction"])

    def test_of_a_dict_are_those_of_its_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "strip.toml")
            with open(file, "w") as text:
                text.write(SCENE.format(integrator="bdf2", precision="double"))
            of_file = hysteron_cloth.Simulation(hysteron_cloth.Scene(file))
        fabric = hysteron_cloth.Fabric("wool-tropical", damping=1e-5)
        of_dict = hysteron_cloth.Simulation(strip(fabric=fabric, seconds=0.05, integrator="bdf2", triangles=120))
        for sim in (of_file, of_dict):
            sim.advance(4)
        self.assertEqual(of_dict.state_hash, of_file.state_hash)

    def test_of_a_file_do_not_depend_on_what_it_says_of_pictures_and_metrics(self):
        plain = SCENE.format(integrator="bdf2", precision="double")
        pictured = ('fps = 12\nno-images = true\n' + plain +
                    '[[metric]]\nname = "end"\nkind = "height"\npoint = [0.09, 0, 0]\n')
        hashes = []
        with tempfile.TemporaryDirectory() as folder:
            for text in (plain, pictured):
                file = os.path.join(folder, "strip.toml")
                with open(file, "w") as scene:
                    scene.write(text)
                sim = hysteron_cloth.Simulation(hysteron_cloth.Scene(file))
                sim.advance(2)
                hashes.append(sim.state_hash)
        self.assertEqual(hashes[1], hashes[0])
        self.assertEqual(hysteron_cloth.Scene("towel-on-rail").to_dict()["cloth"]["shape"], "strip")

    def test_go_on_from_what_was_saved_with_a_hand_that_is_driven(self):
        sim = hysteron_cloth.Simulation(strip())
        sim.advance()
        sim.drive(0, (0, 0, 0.1), spin=20)
        sim.advance(2)
        other = hysteron_cloth.Simulation(strip())
        other.load(sim.save())
        for each in (sim, other):
            each.advance(3)
        self.assertEqual(other.state_hash, sim.state_hash)


class Arrays(unittest.TestCase):
    def test_of_positions_are_the_simulations_memory(self):
        sim = hysteron_cloth.Simulation(strip())
        self.assertEqual(sim.positions.shape, (len(sim.rest_positions), 3))
        self.assertEqual(sim.positions.ctypes.data, sim.positions.ctypes.data)
        self.assertFalse(sim.positions.flags.writeable)
        self.assertFalse(sim.positions.flags.owndata)
        self.assertEqual(hysteron_cloth.Simulation(strip(precision="float")).positions.dtype, np.float32)

    def test_outlive_the_name_of_their_simulation(self):
        sim = hysteron_cloth.Simulation(strip())
        sim.advance(2)
        view, copy = sim.positions, sim.positions.copy()
        del sim
        gc.collect()
        blocks = [np.full(copy.shape, np.nan) for _ in range(50)]  # would take memory that were free
        np.testing.assert_array_equal(view, copy)
        self.assertEqual(len(blocks), 50)

    def test_of_elements_have_a_row_each(self):
        for element, columns in (("hinge", ()), ("shape", (3,))):
            sim = hysteron_cloth.Simulation(strip(element=element, law="prandtl"))
            sim.advance(3)
            count = len(sim.triangles) if element == "shape" else len(sim.friction_share)
            self.assertEqual(sim.curvature.shape, (count, *columns))
            self.assertEqual(sim.moment.shape, (count, *columns))
            self.assertEqual(sim.friction_share.shape, (count,))
            self.assertGreater(np.abs(sim.curvature).max(), 0)

    def test_balance(self):
        sim = hysteron_cloth.Simulation(strip())
        sim.advance(5)
        ledger = sim.ledger
        self.assertLess(ledger["gravitational"], 0)
        self.assertLess(abs(ledger["remainder"]), 1e-9 * abs(ledger["gravitational"]))


class Hands(unittest.TestCase):
    def test_that_are_driven_move_at_the_velocity_they_are_given(self):
        for integrator in ("implicit", "semi-implicit", "tr-bdf2"):
            with self.subTest(integrator=integrator):
                sim = hysteron_cloth.Simulation(strip(integrator=integrator))
                sim.advance()
                held = sim.pin_vertices(0)
                before = sim.positions[held].copy()
                sim.drive(0, (0.1, 0, -0.2))
                sim.advance(4)
                way = 4 * sim.step_seconds * np.array([0.1, 0, -0.2])
                np.testing.assert_allclose(sim.positions[held], before + way, atol=1e-15)
                sim.drive(0, (0, 0, 0))
                sim.advance(2)
                np.testing.assert_allclose(sim.positions[held], before + way, atol=1e-15)
                np.testing.assert_allclose(sim.hand(0)[0], way, atol=1e-15)

    def test_turn_about_the_axis_of_their_pin(self):
        pin = {"low": (-1, -1, -1), "high": (0.01, 1, 1), "axis": (0, 1, 0), "center": (0, 0, 0)}
        sim = hysteron_cloth.Simulation(strip(pin=[pin]))
        held = sim.pin_vertices(0)
        start = sim.positions[held].copy()
        sim.drive(0, (0, 0, 0), spin=90)
        sim.advance(10)
        angle = np.radians(90 * sim.time)
        np.testing.assert_allclose(sim.positions[held][:, 2], -np.sin(angle) * start[:, 0], atol=1e-14)
        self.assertAlmostEqual(sim.hand(0)[1], 90 * sim.time)

    def test_that_there_are_not_are_refused(self):
        with self.assertRaises(hysteron_cloth.RequestError) as raised:
            hysteron_cloth.Simulation(strip()).drive(1, (0, 0, 0))
        self.assertEqual((raised.exception.key, raised.exception.value), ("pin", "1"))


class Loops(unittest.TestCase):
    def test_let_other_threads_run_and_one_at_a_time_step(self):
        sim = hysteron_cloth.Simulation(strip(triangles=400))
        seen = []
        stepping = threading.Thread(target=lambda: sim.advance(40))
        stepping.start()
        while stepping.is_alive():
            try:
                seen.append(sim.steps)
            except hysteron_cloth.RequestError as refusal:
                seen.append(str(refusal))
        stepping.join()
        self.assertIn("the simulation is stepping on another thread", seen)
        self.assertEqual(sim.steps, 40)

    def test_end_between_two_steps_on_an_interrupt(self):
        sim = hysteron_cloth.Simulation(strip(triangles=400))
        signal.signal(signal.SIGALRM, signal.default_int_handler)  # as Ctrl-C, in time
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with self.assertRaises(KeyboardInterrupt):
            sim.advance(10**6)
        taken = sim.steps
        sim.advance()
        self.assertEqual(sim.steps, taken + 1)


class Scenes(unittest.TestCase):
    def test_have_the_keys_of_files(self):
        scene = strip(self_contact=True, fabric="wool-tropical", fabric_k0=33, param={"stops": 16})
        self.assertEqual(scene["fabric.k0"], 33)
        self.assertIs(scene["self-contact"], True)
        self.assertEqual(scene["param"], {"stops": "16"})
        self.assertEqual(scene.fabric.k0, 33)
        scene["triangles"] = 50
        self.assertEqual(scene.to_dict()["triangles"], 50)
        self.assertEqual(scene.to_dict()["pin"][0]["high"], [0.01, 1, 1])

    def test_names_of_all_keys_are_apart_in_python(self):
        plain = [row["key"].replace("-", "_").replace(".", "_") for row in hysteron_cloth.scene_keys()]
        self.assertGreater(len(plain), 50)
        self.assertEqual(len(set(plain)), len(plain))

    def test_are_refused_with_key_and_value(self):
        cases = (({"triangles": 0}, "triangles", "0"), ({"fabric_b2": -1}, "fabric.b2", "-1"),
                 ({"cloth": {"length": "long"}}, "cloth.length", None), ({"fabric_b1": 1e-9}, "fabric.b1", "1e-09"),
                 ({"pin": [{"hihg": (0, 0, 0)}]}, "pin[0].hihg", None))
        for keys, key, value in cases:
            with self.subTest(keys=keys), self.assertRaises(hysteron_cloth.RequestError) as raised:
                strip(**keys)
            self.assertEqual(raised.exception.key, key)
            if value is not None:
                self.assertEqual(raised.exception.value, value)


if __name__ == "__main__":
    unittest.main()
