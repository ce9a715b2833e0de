"""The program that Python starts: where it is found, and whether it is the module's."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings
from unittest import mock

from support import PROGRAM, hysteron_cloth, program

LOCATION = hysteron_cloth.program
BUILD = pathlib.Path(hysteron_cloth.__file__).resolve().parents[2]  # its folder, if the package is in one


def script(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("#!/bin/sh\n" + text)
    file.chmod(0o755)
    return file


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()

    def found(self, **variables):
        """Returns what a package in self.folder/lib/hysteron_cloth finds with these variables of the environment."""
        package = self.folder / "build" / "python" / "hysteron_cloth"
        with mock.patch.object(LOCATION, "__file__", str(package / "program.py")), \
                mock.patch.dict(os.environ, {"PATH": str(self.folder / "path"), **variables}):
            if "HYSTERON_PROGRAM" not in variables:
                del os.environ["HYSTERON_PROGRAM"]
            return LOCATION.find_program()

    def test_is_the_one_that_is_named_else_the_nearest(self):
        with self.assertRaisesRegex(hysteron_cloth.MachineError, "no program at .*; set HYSTERON_PROGRAM"):
            self.found()
        places = ["path/hysteron", "build/hysteron", "build/python/hysteron_cloth/hysteron"]
        for place in places:  # each is nearer than those before it
            file = script(self.folder / place, "")
            self.assertEqual(self.found(), str(file))
        named = script(self.folder / "mine", "")
        self.assertEqual(self.found(HYSTERON_PROGRAM=str(named)), str(named))

    def test_that_is_named_and_not_there_is_a_failure(self):
        with self.assertRaisesRegex(hysteron_cloth.MachineError, "HYSTERON_PROGRAM = /no/such") as raised:
            self.found(HYSTERON_PROGRAM="/no/such")
        self.assertEqual((raised.exception.key, raised.exception.value), ("HYSTERON_PROGRAM", "/no/such"))

    def test_is_what_the_command_of_a_wheel_becomes(self):
        command = self.folder / "bin" / "hysteron"
        script(command, "").write_text(f"#!{sys.executable}\nfrom hysteron_cloth.program import main\nmain()\n")
        ran = subprocess.run([command, "kes", "--no-such"], capture_output=True, text=True)
        typed = subprocess.run([PROGRAM, "kes", "--no-such"], capture_output=True, text=True)
        self.assertEqual((ran.returncode, ran.stderr), (2, typed.stderr))
        itself = {**os.environ, "HYSTERON_PROGRAM": str(command)}
        loop = subprocess.run([command], capture_output=True, text=True, env=itself)
        self.assertIn("is not it", loop.stderr)

    def test_of_another_project_is_refused(self):
        other = script(self.folder / "hysteron", "echo 'hysteron 2.1'\n")
        with mock.patch.dict(os.environ, HYSTERON_PROGRAM=str(other)):
            with self.assertRaisesRegex(hysteron_cloth.MachineError, 'is not the program .* "hysteron 2.1"'):
                hysteron_cloth.run("kes")

    def test_of_another_commit_is_warned_of_once(self):
        other = script(self.folder / "hysteron",
                       f"[ $1 = --version ] && echo '0.0.9 (commit 1f3a)' || exec {PROGRAM} $*\n")
        with mock.patch.dict(os.environ, HYSTERON_PROGRAM=str(other)), warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            for _ in range(2):
                with self.assertRaises(hysteron_cloth.RequestError):
                    hysteron_cloth.run("kes", no_such=1)
        self.assertEqual(len(caught), 1)
        self.assertIn(f"{other} is 0.0.9 (commit 1f3a), this Python module {hysteron_cloth.build}",
                      str(caught[0].message))
        self.assertEqual(caught[0].filename, __file__)

    def test_of_the_same_commit_is_not_warned_of(self):
        version = program("--version").strip()
        self.assertRegex(hysteron_cloth.build, LOCATION._VERSION)  # in the same form
        with mock.patch.object(LOCATION._hysteron, "build", version), warnings.catch_warnings():
            warnings.simplefilter("error")
            LOCATION._check_version.cache_clear()
            self.assertEqual(LOCATION.checked_program(), PROGRAM)
        LOCATION._check_version.cache_clear()

    @unittest.skipUnless((BUILD / "CMakeCache.txt").exists(), "the package is in no build folder")
    def test_lies_beside_the_module_in_a_wheel_and_finds_the_assets_there(self):
        subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--prefix", self.folder], check=True,
                       capture_output=True)
        package = self.folder / "hysteron_cloth"
        for file in pathlib.Path(hysteron_cloth.__file__).parent.glob("*.py"):
            shutil.copy(file, package)
        marked = package / "assets" / "fabrics" / "in-the-wheel.toml"
        shutil.copy(package / "assets" / "fabrics" / "cotton-broad.toml", marked)
        code = ("import hysteron_cloth as h; assert h.find_program() == h.__path__[0] + '/hysteron', h.find_program()\n"
                "print(h.run('kes', fabric='in-the-wheel', no_images=True).metrics['B_N_m'])")
        kept = {name: value for name, value in os.environ.items() if not name.startswith("HYSTERON_")}
        ran = subprocess.run([sys.executable, "-c", code], cwd=self.folder, capture_output=True, text=True,
                             env={**kept, "PYTHONPATH": str(self.folder)})
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertAlmostEqual(float(ran.stdout), hysteron_cloth.Fabric("cotton-broad").b2, delta=1e-7)  # [N m]; 1 %


if __name__ == "__main__":
    unittest.main()
