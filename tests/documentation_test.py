"""These tests check what documentation.py writes and finds wrong: `documentation_test.py HYSTERON`."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import documentation

PROGRAM = sys.argv.pop(1)
CREASE = {"hysteron": {}, "steps": 12345, "metrics": {
    "recovery_angle_deg": 127.768, "recovery_angle_deg_step_error": 0.114, "recovery_angle_deg_mesh_error": None,
    "recovery_angle_deg_draw_error": 2.3e-7, "recovery_angle_deg_mean": 126.2, "recovery_angle_deg_mean_stderr": 0.25,
    "set_m": 0}}
ANGLES = ('\n[crease-angle]: ../results/crease/errors.csv "recovery_angle_deg .1f° +-.1g"\n'
          '[run]: ../results/crease/manifest.json\n')


class Checkout(unittest.TestCase):
    """A checkout with a few recorded results, beside which pages of documentation are written."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.docs, self.page = self.root / "docs", self.root / "docs" / "angles.md"
        for name, text in {
                "crease/manifest.json": json.dumps(CREASE),
                "crease/errors.csv": "repeat,differs\nmesh,triangles=4\n",
                "cycles.csv": 'cycle,law,M0 [N],note\n1,wong,5.9e-4,"bent, flat"\n10,wong,4.9e-4,\n10,dahl,-4e-4,\n',
                "means.csv": "fabric,law,area_mean,area_stderr\ncotton,wong,80.14,0.62\ncotton,dahl,70,0.4\n"
                             '"the chapter\'s, wool",wong,51.8,0.07\n',
                "bench.json": '[{"law": "wong", "cloths": 4.0, "ms": 2.5}, {"law": "dahl", "cloths": 4.0, "ms": 5}]',
        }.items():
            self.write("results/" + name, text)

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def write_page(self, text):
        self.write("docs/angles.md", text)

    def run_script(self, *arguments):
        command = [sys.executable, documentation.__file__, "--hysteron", PROGRAM, *arguments, str(self.docs)]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def faults(self):
        """Returns what --check says of the page, without the page's name and the remedy."""
        outcome = self.run_script("--check")
        self.assertEqual(outcome.returncode, 4 if outcome.stderr else 0)
        return outcome.stderr.replace(f"{self.page}:", "").replace(
            f"; write it again: tests/documentation.py {self.docs}", "")

    def written(self):
        outcome = self.run_script()
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        return self.page.read_text(encoding="utf-8")


class LinkedNumbers(Checkout):
    def number(self, file, title):
        return documentation.number_from("results/" + file, title, self.root)

    def refusal(self, file, title):
        with self.assertRaises(documentation.Wrong) as refused:
            self.number(file, title)
        return str(refused.exception)

    def test_are_metrics_pointers_and_cells(self):
        for file, title, expected in (
                ("crease/manifest.json", "recovery_angle_deg .1f°", "127.8°"),
                ("crease/errors.csv", "recovery_angle_deg '.0f %'", "128 %"),
                ("crease/manifest.json", "/steps ,", "12,345"),
                ("crease/manifest.json", "set_m .3f", "0"),
                ("bench.json", "/1/ms .2f", "5.00"),
                ("bench.json", "law=dahl cloths=4 ms .2f", "5.00"),
                ("cycles.csv", "1 'M0 [N]' times 1e3 .2f", "0.59"),
                ("cycles.csv", "cycle=10&law=dahl 'M0 [N]' .1g", "-0.0004"),
                ("cycles.csv", "cycle=10 law=dahl 'M0 [N]' .1g", "-0.0004"),
                ("cycles.csv", "1 note text", "bent, flat"),
                ("cycles.csv", "cycle=10&law=dahl note .1f", "–"),  # an empty cell
                ("means.csv", "'fabric=the chapter's, wool' area_mean .0f", "52")):
            self.assertEqual(self.number(file, title), expected)

    def test_are_subtracted_and_divided(self):
        for file, title, expected in (
                ("crease/manifest.json", "recovery_angle_deg minus /steps .1f", "-12217.2"),
                ("bench.json", "law=dahl ms over law=wong ms times 100 +.0f", "+200"),
                ("bench.json", "/1/ms minus results/cycles.csv 1 'M0 [N]' .4f", "4.9994")):
            self.assertEqual(self.number(file, title), expected)
        refusal = self.refusal("bench.json", "/1/ms over results/crease/manifest.json set_m .1f")
        self.assertEqual(refusal, "this is no finite number")

    def test_carry_the_errors_that_stand_beside_them(self):
        for file, title, expected in (
                ("crease/errors.csv", "recovery_angle_deg .1f° +-.1g", "127.8° ± 0.1 ± 2e-7"),
                ("crease/errors.csv", "recovery_angle_deg times 10 .0f +-.2g", "1278 ± 1.1 ± 2.3e-6"),
                ("crease/errors.csv", "recovery_angle_deg_mean .1f +-.2f°", "126.2 ± 0.11° ± 0.25°"),
                ("means.csv", "fabric=cotton law=wong area_mean .1f +-.1f", "80.1 ± 0.6")):
            self.assertEqual(self.number(file, title), expected)
        for file, title, name in (
                ("crease/errors.csv", "set_m .1f +-.1g", "set_m"),
                ("crease/manifest.json", "/steps , +-.1g", "this number"),
                ("means.csv", "fabric=cotton law=wong area_mean over fabric=cotton law=dahl area_mean .1f +-.1f",
                 "this number")):
            self.assertEqual(self.refusal(file, title), f"{name} has no errors: leave +- out")

    def test_are_refused_in_one_line_that_says_what_is_missing(self):
        for file, title, message in (
                ("crease/errors.csv", "recovery_angel_deg .1f",
                 "results/crease/errors.csv has no metric recovery_angel_deg; did you mean recovery_angle_deg?"),
                ("crease/manifest.json", "/stepz ,", "results/crease/manifest.json has no /stepz"),
                ("cycles.csv", "2 law .1f", "results/cycles.csv has no row 2"),
                ("cycles.csv", "10 'M0 [N]' .1f", "results/cycles.csv has several rows 10"),
                ("cycles.csv", "1 'M1 [N]' .1f", "results/cycles.csv has no column M1 [N]; did you mean M0 [N]?"),
                ("bench.json", "1f", "needs a column"),
                ("crease/errors.csv", "set_m 1f", "format 1f must be like .1f, .2g, +.1f or , for a count"),
                ("crease/errors.csv", "set_m", "needs a format"),
                ("crease/errors.csv", "set_m .1f more", '"more" is one word too many'),
                ("cycles.csv", "1 'M0 [N] .1f", "a quote is not closed")):
            self.assertEqual(self.refusal(file, title), message)

    def test_are_written_into_the_brackets_and_checked(self):
        self.write_page("It opens to [90°][crease-angle]\n"
                        "(the [run][run]; `[7][code]`).\n\n```\na[1][2]\n```\n" + ANGLES)
        steps = '\n[steps]: results/crease/manifest.json "/steps ,"\n'
        self.write("README.md", "Again [1][steps].\n" + steps)
        self.assertEqual(self.faults(), f'{self.root / "README.md"}:1: "1" must be "12,345"\n'
                                        '1: "90°" must be "127.8° ± 0.1 ± 2e-7"\n')
        self.assertEqual(self.written(), "It opens to [127.8° ± 0.1 ± 2e-7][crease-angle]\n"
                                         "(the [run][run]; `[7][code]`).\n\n```\na[1][2]\n```\n" + ANGLES)
        self.assertEqual((self.root / "README.md").read_text(encoding="utf-8"), "Again [12,345][steps].\n" + steps)
        self.assertEqual(self.faults(), "")

    def test_may_be_broken_at_any_blank(self):
        self.write_page("It opens to [127.8° ±\n  0.1 ± 2e-7][crease-angle] (the [run][run]).\n" + ANGLES)
        self.assertEqual(self.faults(), "")

    def test_must_have_a_definition_that_is_used_and_leads_to_a_file(self):
        for text, faults in (
                ('See [1][nowhere].\n\n[idle]: ../results/bench.json "/1/ms .2f"\n',
                 "1: [nowhere] is not defined\n3: [idle] is defined and never used\n"),
                ("See [a][gone] and\n[b](../gone.md#part), [c](#part), [d](https://example.org).\n\n[gone]: gone.md\n",
                 "2: no file ../gone.md\n2: no heading #part in this page\n4: no file gone.md\n"),
                ('See [2][x].\n\n[x]: ../results/bench.json "/1/ms .0f"\n[x]: ../results/bench.json "/0/ms .0f"\n',
                 "4: [x] is defined twice\n"),
                ('See [5][x].\n\n[x]: ../results/bench.json "/7/ms .0f"\n',
                 "3: [x]: ../results/bench.json has no /7/ms\n")):
            self.write_page(text)
            self.assertEqual(self.faults(), faults)
        self.assertEqual(self.run_script().returncode, 4, "writing does not mend it")


class Tables(Checkout):
    def assert_table(self, words, expected):
        """That it is what is written below the opening comment."""
        begin, end = f"# Areas\n\n<!-- table {words} -->\n", "<!-- /table -->\n\nAfter it.\n"
        self.write_page(begin + "stale\n" + end)
        self.assertEqual(self.faults(), "3: this table is not what its files say\n")
        self.assertEqual(self.written(), begin + expected + end)
        self.assertEqual(self.faults(), "")

    def test_have_rows_by_name_and_cells_of_their_columns(self):
        self.assert_table(
            "../results/means.csv 'fabric={}' | fabric / of = cotton as cotton broad / thread; the chapter's, wool\n"
            "| area [%] = law=wong area_mean .1f +-.1f | times = law=wong area_mean over ../results/bench.json "
            "law=wong ms .0f",
            "| [fabric](../results/means.csv) | of     |   area [%] | times |\n"
            "|--------------------------------|--------|-----------:|------:|\n"
            "| cotton broad                   | thread | 80.1 ± 0.6 |    32 |\n"
            "| the chapter's, wool            |        | 51.8 ± 0.1 |    21 |\n")

    def test_have_a_row_for_each_value_of_a_column_and_for_each_file(self):
        self.assert_table("../results/bench.json law={} | law = each law | ms = ms .1f | name = law text",
                          "| [law](../results/bench.json) |  ms | name |\n"
                          "|------------------------------|----:|------|\n"
                          "| wong                         | 2.5 | wong |\n"
                          "| dahl                         | 5.0 | dahl |\n")
        self.assert_table(
            "../results/{}/manifest.json | run = crease as a crease | angle = recovery_angle_deg .1f° | "
            "M0 [mN] = ../results/cycles.csv 1 'M0 [N]' times 1e3 .2f",
            "| run                                         |  angle | M0 [mN] |\n"
            "|---------------------------------------------|-------:|--------:|\n"
            "| [a crease](../results/crease/manifest.json) | 127.8° |    0.59 |\n")

    def test_say_which_row_or_column_is_missing(self):
        for words, fault in (
                ("../results/bench.json law={} | law = wong; prandtl | ms = ms .1f",
                 "prandtl, ms: ../results/bench.json has no row law=prandtl"),
                ("../results/bench.json law={} | law = each element | ms = ms .1f",
                 "../results/bench.json has no column element"),
                ("../results/bench.json law={} | law = wong | ms", '"ms" must be HEAD = what stands below it'),
                ("../results/bench.json", "a table needs a file, its rows and a column, with | between them")):
            self.write_page(f"Like `<!-- table`:\n<!-- table {words} -->\n<!-- /table -->\n")
            self.assertEqual(self.faults(), f"2: {fault}\n")
        self.write_page("\n<!-- table ../results/bench.json | law = wong | ms = ms .1f -->\n")
        self.assertEqual(self.faults(), "2: a table must end with <!-- /table --> below it\n")


class TablesOfTheProgram(Checkout):
    def test_of_keys_have_as_many_cells_in_every_line(self):
        tables = subprocess.run([PROGRAM, "list", "keys"], check=True, capture_output=True, text=True).stdout
        rows = [line for line in tables.splitlines() if line.startswith("|")]
        self.assertGreater(len(rows), 60)
        self.assertEqual({row.replace("\\|", "").count("|") for row in rows}, {7})

    def test_are_written_between_their_comments_and_checked(self):
        empty = "# Keys\n\n<!-- keys:begin -->\n<!-- keys:end -->\n\nAfter them.\n"
        self.write_page(empty)
        self.assertEqual(self.faults(), "3: these tables are not what --help says now\n")
        self.assertEqual(self.page.read_text(encoding="utf-8"), empty, "--check writes nothing")
        before, after = self.written().split("\n### Scene\n")
        self.assertEqual(before, "# Keys\n\n<!-- keys:begin -->\n")
        self.assertTrue(after.endswith("|\n\n<!-- keys:end -->\n\nAfter them.\n"))
        self.assertEqual(self.faults(), "")

    def test_of_exit_codes_are_those_of_help(self):
        self.write_page("<!-- exit-codes:begin -->\n<!-- exit-codes:end -->\n")
        table = self.written()
        self.assertIn("\n| 2 | the request is wrong |\n", table)
        self.assertRegex(table, r"\n\| 4 \| `diff`: a picture is beyond a limit; .*`verify`: ")

    def test_without_their_end_are_told(self):
        self.write_page("<!-- keys:begin -->\n")
        self.assertEqual(self.faults(), "1: <!-- keys:begin --> needs <!-- keys:end --> below it\n")


if __name__ == "__main__":
    unittest.main()
