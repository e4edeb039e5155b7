# SPDX-License-Identifier: MIT
"""long_lines.py: a file with more long lines than the list allows is found; nothing else is."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).with_name("long_lines.py")


class LongLines(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        subprocess.run(["git", "init", "--quiet"], cwd=self.folder, check=True)

    def check(self, name, text, allowed=""):
        (self.folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        subprocess.run(["git", "add", name], cwd=self.folder, check=True)
        listed = self.folder / ".git" / "allowed.txt"
        listed.write_text(allowed, encoding="utf-8")
        done = subprocess.run([sys.executable, "-B", SCRIPT, self.folder, listed], capture_output=True, text=True)
        return done.returncode, done.stdout

    def test_characters_are_counted_and_not_bytes(self):
        self.assertEqual(self.check("a.c", "ẋ" * 120 + "\n"), (0, ""))
        status, said = self.check("a.c", "\n" + "ẋ" * 121 + "\n")
        self.assertEqual(status, 1)
        self.assertEqual(said, "a.c:2: expected at most 0 lines of more than 120 characters, found 1: break them\n")

    def test_as_many_as_the_list_allows(self):
        text = "\n".join(["x" * 121] * 2)
        self.assertEqual(self.check("a.c", text, "# before the rule\n2 a.c\n"), (0, ""))
        self.assertEqual(self.check("a.c", text, "1 a.c\n")[0], 1)

    def test_fewer_are_told_and_are_no_failure(self):
        status, said = self.check("a.c", "int a;\n", "2 a.c\n")
        self.assertEqual((status, "a.c has 0 long lines" in said), (0, True))

    def test_a_row_of_a_table_may_be_long_in_markdown_only(self):
        row = "| " + "x" * 121 + " |\n"
        self.assertEqual(self.check("a.md", row), (0, ""))
        self.assertEqual(self.check("a.txt", row)[0], 1)

    def test_what_is_no_text_is_not_asked(self):
        self.assertEqual(self.check("a.bin", b"\xff" * 200), (0, ""))


if __name__ == "__main__":
    unittest.main()
