# SPDX-License-Identifier: MIT
"""What the tests of the package have in common."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import tinylqg

SOURCE = Path(os.environ["TINYLQG_SOURCE"])
DESIGNS = [design for folder in ("codegen", "test") for design in sorted((SOURCE / folder / "designs").glob("*.toml"))]
BUILT_LQGEN = os.environ["TINYLQG_LQGEN"]  # the build's own, which the wheel's has to equal


def run(*command, cwd=None):
    return subprocess.run(
        [str(word) for word in command],
        cwd=cwd,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


class InFolder(unittest.TestCase):
    """Each test has a folder of its own and works in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.folder = Path(folder.name)

    def refused(self, *parts):
        """A context in which a DesignError with all of `parts` has to come."""
        return Refused(self, parts)


class Refused:
    def __init__(self, test, parts):
        self.test, self.parts = test, parts

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        self.test.assertIsNotNone(kind, f"expected a refusal with {self.parts}")
        if not issubclass(kind, tinylqg.DesignError):
            return False
        for part in self.parts:
            self.test.assertIn(part, str(error))
        return True
