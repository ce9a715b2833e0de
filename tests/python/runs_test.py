"""Experiments that Python starts: the command line's bits and files, failures as exceptions, cancelling."""

import contextlib
import io
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from support import PROGRAM, hysteron_cloth, np, program

SMALL = dict(quick=True, no_images=True, triangles=40, seconds=0.1, threads=1)
WORDS = ["--quick", "--no-images", "--triangles", "40", "--seconds", "0.1", "--threads", "1"]
LONG = dict(no_images=True, triangles=100, seconds=0.2, step=1e-3, threads=1)  # many steps

# The obstacle appears where the cloth is.
HOPELESS = """
seconds = 0.1
step = 0.01
triangles = 40
cloth.length = 0.1
[[obstacle]]
kind = "sphere"
center = [0.05, 0.05, 0]
radius = 0.02
from = 0.02
"""

STUDY = """
experiment = "swing"
[scene]
no-images = true
triangles = 40
seconds = 0.05
[[axis]]
key = "fabric.b2"
values = [1e-5, 2e-5]
"""


class InFolder(unittest.TestCase):
    """Each test in an empty current folder; warnings that the program prints are kept."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        self.printed = io.StringIO()
        printing = contextlib.redirect_stderr(self.printed)
        printing.__enter__()
        self.addCleanup(printing.__exit__, None, None, None)

    def write(self, name, text):
        file = self.folder / name
        file.write_text(text)
        return file


class Runs(InFolder):
    def test_have_the_bits_and_files_of_the_command_line(self):
        run = hysteron_cloth.run("swing", **SMALL)
        program("swing", *WORDS, "--quiet", "--out", "typed")
        typed = hysteron_cloth.Run("typed")
        self.assertEqual(run.path, self.folder / "out" / "swing")
        self.assertTrue(run.state_hash and run.complete and run.metrics)
        self.assertEqual(run.state_hash, typed.state_hash)
        self.assertEqual(run.metrics, typed.metrics)
        self.assertEqual(run.manifest["files"], typed.manifest["files"])
        self.assertEqual(run.manifest["command"], " ".join(["hysteron swing", *WORDS]))
        for name in ("metrics.csv", "turns.csv"):
            self.assertEqual((run.path / name).read_bytes(), (typed.path / name).read_bytes())

    def test_have_series_by_names_with_units(self):
        run = hysteron_cloth.run("swing", **SMALL, fps=60, out="a")
        seconds = run.series["time [s]"]
        self.assertEqual((seconds.shape, seconds.dtype), ((7,), np.float64))  # six frames and the start
        self.assertAlmostEqual(seconds[-1], 0.1)
        self.assertEqual(run.series["bending_friction [J]"][-1], run.metrics["bending_friction_J"])
        self.assertEqual(set(run.table("turns.csv")), set(hysteron_cloth.read_table("a/turns.csv")))

    def test_give_what_the_program_warns_of(self):
        run = hysteron_cloth.run("swing", **SMALL, progress=False)
        self.assertEqual(run.warnings, run.manifest["warnings"])
        self.assertTrue(run.warnings)
        self.assertEqual(self.printed.getvalue().splitlines(), ["warning: " + text for text in run.warnings])

    def test_hand_each_line_of_progress_on(self):
        lines = []
        hysteron_cloth.run("swing", **SMALL, progress=lines.append)
        self.assertIn("48 triangles", lines[0])
        self.assertGreater(sum(line.startswith("t = ") for line in lines), 1)
        self.assertEqual(self.printed.getvalue(), "")

    def test_take_fabrics_from_files_beside_python(self):
        assets = pathlib.Path(__file__).parents[2] / "assets"
        text = (assets / "fabrics" / "wool-tropical.toml").read_text()
        self.write("my.toml", text.replace('name = "wool-tropical"', 'name = "mine"'))
        run = hysteron_cloth.run("swing", fabric="my.toml", **SMALL)
        self.assertEqual(run.manifest["scene"]["fabric"]["name"], "mine")

    def test_have_pictures_in_their_order_until_another_run_replaces_them(self):
        drawn = {**SMALL, "no_images": False, "size": "64x48", "seconds": 0.01, "probe": "none"}
        try:
            run = hysteron_cloth.run("swing", **drawn)
        except hysteron_cloth.MachineError as failure:
            self.skipTest(str(failure))
        self.assertIn(run.path / "frames" / "0000.png", run.images)
        self.assertIn(run.path / "sheet.png", run.images)
        self.assertTrue(all(image.is_file() for image in run.images))
        manifest = run.path / "manifest.json"  # a later run's, by when it was started
        manifest.write_text(manifest.read_text().replace(run.manifest["started"], "2000-01-01T00:00:00Z"))
        with self.assertRaisesRegex(hysteron_cloth.RequestError, "holds a later run"):
            run.images
        self.assertGreater(len(run.series["time [s]"]), 1)

    def test_take_hardly_longer_than_the_command_line(self):
        kLargestOverhead = 0.3  # [s] a tenth is promised and some hundredths are usual; other tests share the cores
        hysteron_cloth.run("swing", **SMALL)
        python, shell = [], []
        for _ in range(3):
            start = time.perf_counter()
            hysteron_cloth.run("swing", **SMALL)
            python.append(time.perf_counter() - start)
            start = time.perf_counter()
            program("swing", *WORDS)
            shell.append(time.perf_counter() - start)
        self.assertLess(min(python) - min(shell), kLargestOverhead)

    def test_of_a_folder_without_one_are_refused(self):
        with self.assertRaisesRegex(hysteron_cloth.RequestError, "holds no run"):
            hysteron_cloth.Run(self.folder)
        self.write("manifest.json", "[1, 2]")
        with self.assertRaisesRegex(hysteron_cloth.RequestError, "not the manifest of a run"):
            hysteron_cloth.Run(self.folder)


class Options(unittest.TestCase):
    def words(self, **options):
        return list(hysteron_cloth.program.option_words("drape", options))

    def test_have_underscores_for_hyphens_and_dots(self):
        self.assertEqual(self.words(no_images=True, fabric_b2=1e-5, drape_standard="jis", fabric="my.toml"),
                         ["--no-images", "--fabric.b2", "1e-05", "--drape.standard", "jis", "--fabric", "my.toml"])
        self.assertEqual(self.words(**{"cloth.warp-angle": 30, "fabric.weft_bending": 2}),
                         ["--cloth.warp-angle", "30", "--fabric.weft-bending", "2"])

    def test_that_are_none_are_left_to_the_program(self):
        self.assertEqual(self.words(fabrc_b="x", **{"no.such_key": 1}), ["--fabrc-b", "x", "--no.such_key", "1"])

    def test_of_every_experiment_have_names_of_their_own(self):
        for experiment in ("drape", "crease", "fold", "crumple", "swing", "run", "compare", "sweep", "kes", "fit"):
            options = hysteron_cloth._hysteron._experiment_options(experiment)
            names = {option.replace(".", "_").replace("-", "_") for option in options}
            self.assertEqual(len(names), len(set(options)))
            self.assertGreater(len(names), 5)
        self.assertEqual(hysteron_cloth._hysteron._experiment_options("no such"), [])

    def test_take_bools_numbers_lists_and_dicts(self):
        self.assertEqual(self.words(self_contact=False, quick=None, seed=3), ["--self-contact=false", "--seed", "3"])
        self.assertEqual(self.words(gravity=(0, 0, -9.8), camera_direction=np.array([-1.0, 0.5, 0])),
                         ["--gravity", "0,0,-9.8", "--camera.direction=-1.0,0.5,0.0"])
        self.assertEqual(self.words(param={"memory": "stops", "stops": np.int64(8)}),
                         ["--param=memory=stops", "--param=stops=8"])
        self.assertEqual(self.words(seconds=np.float64(0.1)), ["--seconds", "0.1"])

    def test_of_another_kind_are_refused(self):
        with self.assertRaisesRegex(hysteron_cloth.RequestError, "fabric = .* must be a bool, a number") as raised:
            self.words(fabric=object())
        self.assertEqual(raised.exception.key, "fabric")


class Failures(InFolder):
    def test_of_a_request_have_the_programs_line_and_its_key(self):
        with self.assertRaises(hysteron_cloth.RequestError) as raised:
            hysteron_cloth.run("swing", fabric_b2=-1, **SMALL)
        typed = subprocess.run([PROGRAM, "swing", "--fabric.b2=-1", *WORDS], capture_output=True, text=True)
        self.assertEqual(typed.returncode, 2)
        self.assertEqual(str(raised.exception), typed.stderr.strip())
        self.assertEqual((raised.exception.key, raised.exception.value), ("fabric.b2", "-1"))
        with self.assertRaisesRegex(hysteron_cloth.RequestError, "unknown option --fabrc; did you mean --fabric"):
            hysteron_cloth.run("swing", fabrc="wool-tropical")
        with self.assertRaisesRegex(hysteron_cloth.RequestError, "unknown subcommand swng; did you mean swing"):
            hysteron_cloth.run("swng")
        self.assertFalse((self.folder / "out").exists())

    def test_of_the_machine_are_machine_errors(self):
        self.write("file", "")
        with self.assertRaisesRegex(hysteron_cloth.MachineError, "hysteron swing: cannot create the folder"):
            hysteron_cloth.run("swing", out="file/below", **SMALL)

    def test_of_a_run_say_where_what_it_has_written_is(self):
        scene = self.write("inside.toml", HOPELESS)
        with self.assertRaisesRegex(hysteron_cloth.RunError, "hysteron run: at t = 0.02 s an obstacle") as raised:
            hysteron_cloth.run("run", scene, no_images=True)
        self.assertEqual(raised.exception.path, self.folder / "out" / "run-inside")
        self.assertFalse(hysteron_cloth.Run(raised.exception.path).complete)

    def test_of_a_program_that_is_killed_name_the_signal(self):
        job = hysteron_cloth.start("swing", **LONG)
        os.kill(job._process.pid, signal.SIGKILL)
        with self.assertRaisesRegex(hysteron_cloth.MachineError, "hysteron swing was ended by SIGKILL"):
            job.wait()

    def test_are_requests_that_write_no_run(self):
        hysteron_cloth.run("swing", **SMALL)
        with self.assertRaisesRegex(hysteron_cloth.RequestError, "--explain .*has run nothing .* in .*out/swing"):
            hysteron_cloth.run("swing", explain=True, no_images=True)


class Cancelling(InFolder):
    def test_keeps_a_checkpoint_from_which_the_same_bits_come(self):
        whole = hysteron_cloth.run("swing", **LONG, out="whole")
        jobs = []
        jobs.append(hysteron_cloth.start("swing", **LONG, checkpoint=1000, out="cut",
                                         progress=lambda line: line.startswith("t = ") and jobs[0].cancel()))
        with self.assertRaisesRegex(hysteron_cloth.Cancelled, "SIGINT at t = .*--resume") as raised:
            jobs[0].wait()
        self.assertIn(str(self.folder / "cut"), str(raised.exception))
        self.assertFalse(jobs[0].running)
        again = hysteron_cloth.run("swing", **LONG, checkpoint=1000, out="cut", resume=True)
        self.assertEqual(again.state_hash, whole.state_hash)

    def test_without_a_checkpoint_says_what_is_kept(self):
        job = hysteron_cloth.start("swing", **LONG)
        self.assertTrue(job.running)
        while not (job.path / "manifest.json").exists():
            time.sleep(0.01)
        job.cancel()
        with self.assertRaisesRegex(hysteron_cloth.Cancelled, "kept in .*out/swing, without a checkpoint"):
            job.wait()
        with self.assertRaises(hysteron_cloth.Cancelled):  # as often as it is asked
            job.wait()

    def test_by_control_c_leaves_an_interrupt_and_no_program(self):
        def interrupt(line):
            if line.startswith("t = "):
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaisesRegex(KeyboardInterrupt, "SIGINT at t = .*--resume"):
            hysteron_cloth.run("swing", **LONG, checkpoint=1000, progress=interrupt)
        self.assertFalse(hysteron_cloth.jobs._going_on)

    def test_by_what_progress_raises_ends_the_program(self):
        with self.assertRaises(ZeroDivisionError):
            hysteron_cloth.run("swing", **LONG, progress=lambda line: 1 / 0)
        self.assertFalse(hysteron_cloth.jobs._going_on)

    def test_of_a_study_keeps_the_runs_that_are_complete(self):
        study = self.write("soft.toml", STUDY.replace("[1e-5, 2e-5]", "[1e-5, 2e-5, 3e-5, 4e-5, 5e-5, 6e-5]"))
        jobs = []
        jobs.append(hysteron_cloth.start("sweep", study, jobs=1, out="cut",
                                         progress=lambda line: line.startswith("1/6") and jobs[0].cancel()))
        with self.assertRaisesRegex(hysteron_cloth.Cancelled, "complete are kept in .*cut: resume=True"):
            jobs[0].wait()
        whole = hysteron_cloth.sweep(study, jobs=1, out="cut", resume=True)
        self.assertTrue(1 <= whole.metrics["kept_count"] < 6, whole.metrics)
        self.assertEqual(len(whole.runs), 6)

    def test_at_the_end_of_python_leaves_no_program(self):
        script = ("import hysteron_cloth\n"
                  f"job = hysteron_cloth.start('swing', **{dict(LONG, seconds=60.0)!r})\n"
                  "print(job._process.pid)\n")
        ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True,
                               check=True)
        with self.assertRaises(ProcessLookupError):
            os.kill(int(ended.stdout), 0)


class Several(InFolder):
    def test_laws_are_columns_of_a_comparison(self):
        both = hysteron_cloth.compare("swing", ["linear", "prandtl"], **SMALL)
        self.assertEqual(both.path, self.folder / "out" / "compare-swing")
        self.assertEqual(list(both.columns), ["linear", "prandtl"])
        alone = both.columns["prandtl"]
        self.assertEqual(alone.metrics["bending_friction_J"], both.metrics["prandtl.bending_friction_J"])
        self.assertGreater(alone.series["bending_friction [J]"][-1], 0)
        self.assertEqual(both.columns["linear"].series["bending_friction [J]"][-1], 0)

    def test_runs_of_a_study_are_rows_of_a_table(self):
        self.write("soft.toml", STUDY)
        lines = []
        study = hysteron_cloth.sweep("soft.toml", jobs=1, progress=lines.append)
        self.assertEqual(study.path, self.folder / "out" / "sweep-soft")
        np.testing.assert_array_equal(study.table()["fabric.b2"], [1e-5, 2e-5])
        self.assertEqual(len(study.runs), 2)
        for name, state_hash in zip(study.table()["run"], study.table()["state_hash"]):
            self.assertEqual(study.runs[name].state_hash, state_hash)
        self.assertTrue(lines[1].startswith("2/2 "), lines)

    def test_jobs_run_beside_each_other(self):
        jobs = [hysteron_cloth.start("swing", **SMALL, law=law, out=law) for law in ("linear", "prandtl")]
        linear, prandtl = [job.wait() for job in jobs]
        self.assertNotEqual(linear.state_hash, prandtl.state_hash)
        self.assertIn("law prandtl", jobs[1].text)


class Tables(InFolder):
    def test_have_numbers_where_all_cells_are(self):
        file = self.write("a.csv", 'run,x [m],"a, b",state_hash\n1,2.5,,12345678\n2,,c,00000000\n')
        table = hysteron_cloth.read_table(file)
        self.assertEqual(list(table), ["run", "x [m]", "a, b", "state_hash"])
        np.testing.assert_array_equal(table["x [m]"], [2.5, np.nan])
        self.assertEqual(table["a, b"].tolist(), ["", "c"])
        self.assertEqual(table["run"].tolist(), ["1", "2"])
        self.assertEqual(table["state_hash"].tolist(), ["12345678", "00000000"])

    def test_that_are_not_there_are_machine_errors(self):
        with self.assertRaisesRegex(hysteron_cloth.MachineError, "cannot read nowhere.csv"):
            hysteron_cloth.read_table("nowhere.csv")


if __name__ == "__main__":
    unittest.main()
