"""These tests check what results/speed/steps.py writes of programs that take turns.

    steps_test.py build/hysteron
"""
import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

STEPS = Path(__file__).resolve().parent.parent / "results/speed/steps.py"
PROGRAM = sys.argv.pop()


class Steps(unittest.TestCase):
    def test_programs_take_turns(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(
                [sys.executable, STEPS, "--program", f"one={PROGRAM}", "--program", f"other={PROGRAM}", "--out", folder,
                 "--repeats", "1", "--device", "cpu", "--runs", "swing-1014"],
                check=True, capture_output=True)
            with open(Path(folder, "table.csv")) as file:
                one, other = csv.DictReader(file)
        self.assertEqual([one["program"], other["program"]], ["one", "other"])
        for row in (one, other):
            self.assertEqual(row["runs"], "1")
            self.assertLessEqual(float(row["fastest"]), float(row["ms_per_step"]))
            self.assertLessEqual(float(row["ms_per_step"]), float(row["slowest"]))
        for column in ("newton", "linear", "commit"):  # one program does one thing
            self.assertEqual(one[column], other[column])


if __name__ == "__main__":
    unittest.main()
