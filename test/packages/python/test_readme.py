# SPDX-License-Identifier: MIT
"""The chapters of the package's page that need Python alone; those of Octave and Scilab stand with their tests."""

import unittest

from designs import InFolder
from readme import run_chapter


class Readme(InFolder):
    def test_python_control(self):
        run_chapter("python-control", "python", "sh")

    def test_scipy(self):
        run_chapter("scipy", "python")


if __name__ == "__main__":
    unittest.main()
