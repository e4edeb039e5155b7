# SPDX-License-Identifier: MIT
"""named_paths.py: what is named and not there is found, by its line; nothing else is."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).with_name("named_paths.py")


class NamedPaths(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write(".pre-commit-config.yaml", "repos: []\n")
        self.write("test/run.sh", "#!/usr/bin/env bash\n")
        self.write("test/README.md", "# All `tests`, and more\n\n```sh\n# no heading\n```\n")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def check(self, name, text):
        self.write(name, text)
        done = subprocess.run([sys.executable, "-B", SCRIPT, self.root], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1 if done.stdout else 0)
        return done.stdout.replace("expected the path of something in the tree, found ", "").splitlines()

    def test_a_program_that_a_workflow_runs(self):
        name = ".github/workflows/ci.yml"
        self.assertEqual(self.check(name, "steps:\n  - run: test/run.sh --firmware\n"), [])
        self.assertEqual(self.check(name, "steps:\n  - run: test/walk.sh --firmware\n"), [f"{name}:2: test/walk.sh"])
        self.assertEqual(self.check(name, "steps:\n  - run: tests/run.sh\n"), [f"{name}:2: tests/run.sh"])

    def test_actions_addresses_and_what_a_build_makes_are_not_paths(self):
        workflow = "uses: actions/checkout@v1\npath: build/pages\nif: github.ref == 'refs/heads/main'\n"
        self.assertEqual(self.check(".github/workflows/ci.yml", workflow), [])
        self.assertEqual(self.check(".github/a.md", "https://example.org/a/none [a](https://example.org/none)\n"), [])

    def test_a_folder_of_dependabot(self):
        name = ".github/dependabot.yml"
        self.assertEqual(self.check(name, "directories:\n  - /test\n  - /test/github\n"), [f"{name}:3: test/github"])

    def test_a_link_of_a_document(self):
        name = ".github/CONTRIBUTING.md"
        self.assertEqual(self.check(name, "[a](../test/README.md) [b](CONTRIBUTING.md)\n"), [])
        self.assertEqual(
            self.check(name, "[a](test/README.md)\n[b](../README.md)\n"),
            [f"{name}:1: test/README.md", f"{name}:2: ../README.md"],
        )

    def test_a_heading_of_a_link(self):
        name = ".github/CONTRIBUTING.md"
        self.assertEqual(self.check(name, "[a](../test/README.md#all-tests-and-more)\n# Here\n[b](#here)\n"), [])
        self.assertEqual(self.check(name, "[a](../test/README.md#none)\n"), [f"{name}:1: ../test/README.md#none"])


if __name__ == "__main__":
    unittest.main()
