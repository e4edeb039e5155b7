# SPDX-License-Identifier: MIT
"""test/unity.sh: what has not the hash is not unpacked, and nothing of what is fetched runs."""

import hashlib
import io
import os
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path

SCRIPT = sys.argv.pop(1)
ROOT = "pytest_unity-0.1.0"
HARM = "import pathlib\npathlib.Path({!r}).touch()\n"


class Unity(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.marker = self.folder / "it ran"
        harm = HARM.format(str(self.marker))
        self.sdist = self.folder / "links" / f"{ROOT}.tar.gz"
        self.sdist.parent.mkdir()
        with tarfile.open(self.sdist, "w:gz") as archive:
            for name, text in (
                ("PKG-INFO", "Metadata-Version: 2.1\nName: pytest-unity\nVersion: 0.1.0\n"),
                ("setup.py", harm),
                ("hatchling/__init__.py", harm),
                ("hatchling/build.py", harm),
                ("vendor/unity/src/unity.c", "int unity;\n"),
                (
                    "pyproject.toml",
                    '[build-system]\nrequires = ["there-is-no-such-package"]\nbuild-backend = "hatchling.build"\n',
                ),
            ):
                entry = tarfile.TarInfo(f"{ROOT}/{name}")
                entry.size = len(text)
                archive.addfile(entry, io.BytesIO(text.encode()))

    def run_script(self, digest):
        requirement = self.folder / "unity.txt"
        requirement.write_text(f"pytest-unity==0.1.0 --hash=sha256:{digest}\n")
        environment = {
            **os.environ,
            "PIP_NO_INDEX": "1",
            "PIP_FIND_LINKS": str(self.sdist.parent),
            "HOME": str(self.folder / "home"),
        }
        return subprocess.run(
            ["bash", SCRIPT, self.folder / "unity", requirement],
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )

    def test_another_hash_is_refused_before_anything_is_unpacked(self):
        done = self.run_script("0" * 64)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("DO NOT MATCH THE HASHES", done.stderr)
        self.assertFalse((self.folder / "unity").exists() or self.marker.exists())

    def test_nothing_is_built_or_run(self):
        done = self.run_script(hashlib.sha256(self.sdist.read_bytes()).hexdigest())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "unity" / "src" / "unity.c").read_text(), "int unity;\n")
        self.assertFalse(self.marker.exists())


if __name__ == "__main__":
    unittest.main()
