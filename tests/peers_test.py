"""These tests check what results/speed/peers.py makes of its table: the comparison at equal errors and the figure.

The measurement itself needs other people's solvers and a GPU, which a test has not.
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PEERS = Path(__file__).resolve().parent.parent / "results/speed/peers.py"
sys.path.insert(0, str(PEERS.parent))
import peer_figure  # noqa: E402

COLUMNS = "material,tension_N_per_m,triangles,solver,setting,ms_per_simulated_ms,rms_mm,note"
ROWS = """woven,1000,8,hysteron,bdf2 1/20 s,0.1,12,
woven,1000,8,hysteron,bdf2 1/40 s,0.2,6,
woven,1000,8,hysteron,tr-bdf2 1/60 s,0.5,0.5,
woven,1000,8,style3d,"1/120 s, 10 x 10",1,90,more than 60 mm away
woven,1000,8,style3d,"1/120 s, 300 x 10",5,13,
woven,1000,8,style3d,"1/60 s, 600 x 10",6,15,
woven,10000,8,hysteron,bdf2 1/40 s,0.3,6,
woven,10000,8,style3d,"1/120 s, 300 x 10",5,,positions are no finite numbers
isotropic,1000,8,hysteron,bdf2 1/40 s,0.2,5,
isotropic,1000,8,vbd,"1/600 s, 10",0.4,7,
isotropic,1000,8,vbd,"1/960 s, 40",2,1,
"""


class Comparison(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, rows):
        (self.folder / "table.csv").write_text(f"{COLUMNS}\n{rows}", "utf-8")

    def draw(self):
        return subprocess.run([sys.executable, PEERS, "draw", self.folder], capture_output=True, text=True)

    def found(self, solver, tension, at):
        rows = {(row["solver"], row["tension_N_per_m"], row["at_mm"]): row
                for row in peer_figure.read_table(self.folder / "fastest.csv")}
        return rows[solver, tension, at]

    def test_is_with_the_fastest_own_run_that_is_at_least_as_near(self):
        self.write(ROWS)
        self.assertEqual(self.draw().returncode, 0)
        row = self.found("style3d", "1000", "best")
        self.assertEqual((row["setting"], row["rms_mm"], row["hysteron_setting"], row["settings_tried"]),
                         ("1/120 s, 300 x 10", "13", "bdf2 1/20 s", "3"))
        self.assertEqual(float(row["times_as_long"]), 5 / 0.1)

    def test_takes_the_fastest_of_both_within_an_error_in_the_same_material(self):
        self.write(ROWS)
        self.draw()
        row = self.found("vbd", "1000", "8")
        self.assertEqual((row["setting"], row["hysteron_setting"], row["times_as_long"]),
                         ("1/600 s, 10", "bdf2 1/40 s", "2"))
        self.assertEqual(self.found("vbd", "1000", "2")["note"], "hysteron was not run as near")

    def test_says_where_a_peer_does_not_arrive(self):
        self.write(ROWS)
        self.draw()
        self.assertEqual(self.found("style3d", "1000", "8")["note"], "none within 8 mm")
        self.assertEqual(self.found("style3d", "10000", "best")["note"], "none within 60 mm")

    def test_has_a_figure_of_every_error_that_was_measured(self):
        self.write(ROWS)
        self.draw()
        self.assertTrue((self.folder / "plot_peers.png").read_bytes().endswith(b"IEND\xaeB`\x82"))
        drawing = (self.folder / "plot_peers.svg").read_text("utf-8")
        for text in ("8 triangles, 1 kN/m", "8 triangles, 10 kN/m", "hysteron bdf2", "Style3D", "VBD, isotropic"):
            self.assertIn(text, drawing)
        self.assertNotIn("libuipc", drawing)
        script = peer_figure.figure_script(peer_figure.read_table(self.folder / "table.csv"), "plot", "svg")
        drawn = [line for line in script.splitlines() if line[0].isdigit()]
        self.assertEqual(len(drawn), sum(bool(row.split(",")[-2]) for row in ROWS.splitlines()))
        self.assertIn("1.0 90.0", drawn)

    def test_of_a_table_without_errors_is_refused(self):
        self.write("woven,1000,8,style3d,\"1/120 s, 300 x 10\",5,,positions are no finite numbers\n")
        done = self.draw()
        self.assertEqual((done.returncode, done.stderr), (1, f"{self.folder / 'table.csv'} has no error to draw\n"))


if __name__ == "__main__":
    unittest.main()
