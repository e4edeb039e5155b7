# SPDX-License-Identifier: MIT
"""python3 test_compare.py LQGEN DESIGNS: `lqgen compare` writes one page of several designs, or says why not."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

LQGEN, DESIGNS = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()


def cells(page, title):
    """The rows of the first table behind a heading, as lists of text."""
    section = page[page.index(f">{title}<") :]
    table = section[section.index("<table") : section.index("</table>")]
    rows = re.findall(r"<tr>(.*?)</tr>", table, re.DOTALL)
    return [
        [re.sub("<[^>]*>", "", cell) for cell in re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row, re.DOTALL)]
        for row in rows
    ]


class Compare(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        self.servo = (DESIGNS / "servo.toml").read_text(encoding="utf-8")

    def tearDown(self):
        self.temporary.cleanup()

    def put(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def run_lqgen(self, *arguments):
        return subprocess.run(
            [LQGEN, "compare", *arguments], cwd=self.folder, capture_output=True, text=True, timeout=300, check=False
        )

    def page(self):
        return (self.folder / "compare.html").read_text(encoding="utf-8")

    def compare_two(self):
        self.put("servo.toml", self.servo)
        other = self.servo.replace("[0.05, 30]", "[0.020, 30]").replace('"servo"', '"stiff"')
        self.put("stiff.toml", other.replace("# A servo", "# Another servo"))
        done = self.run_lqgen("servo.toml", "stiff.toml", "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_the_difference_of_the_files_stands_first(self):
        self.compare_two()
        page = self.page()
        rows = cells(page, "What differs in the files")
        self.assertEqual(rows[0], ["key", "servo", "stiff"])
        self.assertEqual(
            rows[1:], [["name", "&quot;servo&quot;", "&quot;stiff&quot;"], ["lqr.bryson.states[0]", "0.05", "0.020"]]
        )
        self.assertLess(page.index("What differs in the files"), page.index(">In numbers<"))
        self.assertLess(page.index(">In numbers<"), page.index(">At work<"))

    def test_figures_are_those_of_each_design_alone(self):
        self.compare_two()
        rows = {row[0]: row[1:] for row in cells(self.page(), "In numbers")[1:]}
        for column, name in enumerate(("servo", "stiff")):
            subprocess.run([LQGEN, f"{name}.toml", "--only", "json", "--quiet"], cwd=self.folder, check=True)
            margins = json.loads((self.folder / f"{name}.json").read_text())["loop"]
            shown = float(re.match(r"[0-9.]+", rows["Phase margin"][column])[0])
            self.assertAlmostEqual(shown, margins["phase_margin_deg"], delta=0.01)
        self.assertNotEqual(*rows["Phase margin"])

    def test_designs_without_scenarios_move_at_the_same_times(self):
        lines = (DESIGNS / "double_integrator.toml").read_text(encoding="utf-8")
        self.assertNotIn("[[scenario]]", lines)
        self.put("slow.toml", lines)
        self.put("quick.toml", re.sub(r"^R *=.*$", "R = [1e-6]", lines, flags=re.MULTILINE))
        done = self.run_lqgen("slow.toml", "quick.toml", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        data = re.search(r'id="lqg-data">\n(.*?)\n</script>', self.page(), re.DOTALL)[1]
        runs = [chart for chart in json.loads(data)["charts"] if chart["id"].startswith("run-load")]
        self.assertTrue(runs)
        for chart in runs:
            times = {json.dumps(curve["x"]) for curve in chart["curves"] if curve["role"] == "data"}
            self.assertEqual(len(times), 1, chart["id"])

    def test_curves_of_both_stand_in_one_chart(self):
        self.compare_two()
        data = re.search(r'id="lqg-data">\n(.*?)\n</script>', self.page(), re.DOTALL)[1]
        charts = {chart["id"]: chart for chart in json.loads(data)["charts"]}
        nyquist = [chart for name, chart in charts.items() if "nyquist" in name]
        self.assertTrue(nyquist)
        for chart in charts.values():
            labels = [curve["label"] for curve in chart["curves"] if curve["role"] == "data" and curve["label"]]
            self.assertEqual(len(labels), len(set(labels)), labels)
            self.assertTrue(any(label.endswith("servo") for label in labels), chart["id"])
            self.assertTrue(any(label.endswith("stiff") for label in labels), chart["id"])

    def test_designs_of_one_name_are_told_apart_by_their_files(self):
        self.put("one.toml", self.servo)
        self.put("two.toml", self.servo)
        self.put("three.toml", self.servo)
        self.assertEqual(self.run_lqgen("one.toml", "two.toml", "three.toml", "--quiet").returncode, 0)
        self.assertIn("The files say the same.", self.page())
        self.assertEqual(cells(self.page(), "In numbers")[0], ["", "one", "two", "three"])

    def test_designs_of_other_plants_stand_beside_each_other(self):
        done = self.run_lqgen(*(str(DESIGNS / f"{name}.toml") for name in ("servo", "quadrotor", "range_tracker")))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("http://", self.page())

    def test_the_same_designs_give_the_same_bytes(self):
        self.compare_two()
        first = self.page()
        self.compare_two()
        self.assertEqual(first, self.page())

    def test_one_design_that_cannot_be_is_named_and_nothing_is_written(self):
        self.put("good.toml", self.servo)
        for name, text, status in (
            ("wrong.toml", self.servo.replace("[[1, 0]]", "[[1, 0, 0]]"), 2),
            ("impossible.toml", self.servo.replace("phase_margin_deg = 30", "phase_margin_deg = 89"), 1),
            ("missing.toml", None, 3),
        ):
            if text:
                self.put(name, text)
            done = self.run_lqgen("good.toml", name, "--quiet")
            self.assertEqual(done.returncode, status, name)
            self.assertIn(f"{name}:", done.stderr)
            self.assertNotIn("good.toml", done.stderr)
        self.assertFalse((self.folder / "compare.html").exists())

    def test_a_design_is_not_overwritten_and_one_alone_is_refused(self):
        self.put("compare.html", self.servo)
        self.put("servo.toml", self.servo)
        self.assertEqual(self.run_lqgen("servo.toml", "compare.html", "--quiet").returncode, 2)
        self.assertEqual(self.page(), self.servo)
        self.assertEqual(self.run_lqgen("servo.toml").returncode, 2)
        done = self.run_lqgen("servo.toml", "compare.html", "--quiet", "-o", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "out" / "compare.html").exists())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
