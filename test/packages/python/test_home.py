# SPDX-License-Identifier: MIT
"""The tests of the package write below the build folder only."""

import os
import tempfile
import unittest
from pathlib import Path


class Home(unittest.TestCase):
    def test_home_and_temporary_files_are_in_the_build(self):
        for folder in (Path.home(), tempfile.gettempdir(), os.environ["XDG_CACHE_HOME"], os.environ["XDG_CONFIG_HOME"]):
            self.assertTrue(Path(folder).resolve().is_relative_to(Path(os.environ["TINYLQG_BUILD"]).resolve()), folder)


if __name__ == "__main__":
    unittest.main()
