# SPDX-License-Identifier: MIT
"""python -m tinylqg: what it writes, and with which words and exit status it refuses."""

import sys
import unittest
from pathlib import Path

import scipy.io

import tinylqg
from designs import SOURCE, InFolder, run

PLANT = {"A": [[0.0, 1], [0, -2]], "B": [[0.0], [3]], "C": [[1.0, 0]], "Q": [[1.0, 0], [0, 1]], "R": 1.0}


class CommandLine(InFolder):
    def tinylqg(self, *arguments):
        return run(sys.executable, "-m", "tinylqg", *arguments)

    def fails(self, status, words, *arguments):
        done = self.tinylqg(*arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertIn(words, done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def test_import_writes_what_design_text_says(self):
        scipy.io.savemat("motor.mat", PLANT)
        self.assertEqual(self.tinylqg("import", "motor.mat", "--sample-time", "0.1").returncode, 0)
        expected = tinylqg.design_text(**tinylqg.read_mat("motor.mat"), name="motor", sample_time=0.1)
        self.assertEqual(Path("motor.toml").read_text(), expected)
        shown = self.tinylqg("import", "motor.mat", "--sample-time", "0.1", "-o", "-")
        self.assertEqual(shown.stdout, expected)
        self.assertEqual(tinylqg.generate("motor.toml").name, "motor")

    def test_import_takes_words_from_the_command_line(self):
        scipy.io.savemat("plant.mat", {"motor": PLANT, "name": "ignored"})
        done = self.tinylqg(
            "import",
            "plant.mat",
            "--variable",
            "motor",
            "--name",
            "crane",
            "--brief",
            "a crane",
            "--sample-time",
            "0.5",
            "--delay",
            "1.25",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        text = Path("crane.toml").read_text()
        for line in ('name = "crane"', 'brief = "a crane"', "sample_time = 0.5", "delay = 1.25"):
            self.assertIn(line + "\n", text)

    def test_import_keeps_a_file_that_somebody_edited(self):
        scipy.io.savemat("motor.mat", PLANT)
        Path("motor.toml").write_text("# mine\n")
        self.fails(
            2, "motor.toml: expected a file that is not there yet", "import", "motor.mat", "--sample-time", "0.1"
        )
        self.assertEqual(Path("motor.toml").read_text(), "# mine\n")
        self.assertEqual(self.tinylqg("import", "motor.mat", "--sample-time", "0.1", "--force").returncode, 0)
        self.assertNotEqual(Path("motor.toml").read_text(), "# mine\n")

    def test_wrong_input_ends_with_2(self):
        scipy.io.savemat("motor.mat", PLANT)
        self.fails(2, "plant.sample_time: the plant is continuous: expected", "import", "motor.mat")
        self.fails(2, "invalid float value", "import", "motor.mat", "--sample-time", "soon")
        self.fails(2, "required: COMMAND")
        Path("text.mat").write_text("A = 1")
        self.fails(2, "text.mat: expected a .mat file", "import", "text.mat")
        Path("text.json").write_text("{}")
        self.fails(2, "text.json: expected a JSON file that lqgen wrote", "export", "text.json")

    def test_what_cannot_be_read_or_written_ends_with_3(self):
        scipy.io.savemat("motor.mat", PLANT)
        self.fails(3, "missing.mat: No such file", "import", "missing.mat")
        self.fails(
            3, "none/motor.toml: No such file", "import", "motor.mat", "--sample-time", "1", "-o", "none/motor.toml"
        )
        self.fails(3, "missing.json: No such file", "export", "missing.json")

    def test_export_is_save_mat(self):
        design = tinylqg.generate(SOURCE / "codegen" / "designs" / "two_mass.toml")
        self.assertEqual(self.tinylqg("export", "two_mass.json").returncode, 0)
        found = scipy.io.loadmat("two_mass.mat")
        self.assertEqual(found["K"].tolist(), design.K.tolist())
        self.assertEqual(found["Ts"].item(), 0.5)
        self.assertEqual([str(cell.item()) for cell in found["states"].flat], design.plant.states)

    def test_paths(self):
        self.assertTrue(Path(self.tinylqg("include").stdout.strip(), "lqg", "lqg.h").is_file())
        self.assertTrue(Path(self.tinylqg("src").stdout.strip(), "loop.c").is_file())
        self.assertEqual(run(self.tinylqg("lqgen").stdout.strip(), "--version").stdout.strip(), tinylqg.__version__)


if __name__ == "__main__":
    unittest.main()
