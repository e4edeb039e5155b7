# SPDX-License-Identifier: MIT
"""The chapters of the package's page that need Python alone; those of Octave and Scilab stand with their tests."""

import shutil
import unittest

from designs import SOURCE, InFolder
from readme import run_chapter


class Readme(InFolder):
    def test_design_in_memory(self):
        run_chapter("A design in memory", "python")

    def test_what_begins_with_the_servo(self):
        for title in ("Simulation", "Sweeps, on one machine or many", "The controller in your simulator", "Plots"):
            with self.subTest(title):
                shutil.copy(SOURCE / "codegen" / "designs" / "servo.toml", ".")
                run_chapter(title, "python")

    def test_python_control(self):
        run_chapter("python-control", "python", "sh")

    def test_scipy(self):
        run_chapter("scipy", "python")


if __name__ == "__main__":
    unittest.main()
