# SPDX-License-Identifier: MIT
"""new_lines.py: what is new and too long is found, by its line; nothing else is."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).with_name("new_lines.py")


class NewLines(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.git("init", "--quiet")

    def git(self, *arguments):
        author = ["-c", "user.name=nobody", "-c", "user.email=nobody@example.org"]
        subprocess.run(["git", *author, *arguments], cwd=self.folder, check=True)

    def add(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        self.git("add", name)

    def check(self, *names):
        done = subprocess.run([sys.executable, "-B", SCRIPT, *names], cwd=self.folder, capture_output=True, text=True)
        return done.returncode, done.stdout

    def test_a_new_line_of_121_characters_is_found(self):
        self.add("a.c", "int a;\n\n" + "x" * 121 + "\n")
        self.assertEqual(self.check("a.c"), (1, "a.c:3: expected at most 120 characters, found 121: break the line\n"))

    def test_characters_are_counted_and_not_bytes(self):
        self.add("a.c", "ẋ" * 120 + "\n")
        self.assertEqual(self.check("a.c"), (0, ""))

    def test_an_old_line_is_nobodys_fault(self):
        self.add("a.c", "x" * 200 + "\nint a;\n")
        self.git("commit", "--quiet", "--message=old")
        self.add("a.c", "x" * 200 + "\nint b;\n")
        self.assertEqual(self.check("a.c"), (0, ""))

    def test_a_line_that_begins_with_plus_signs_is_a_line(self):
        self.add("a.c", "++ " + "x" * 118 + "\n")
        self.assertEqual(self.check("a.c"), (1, "a.c:1: expected at most 120 characters, found 121: break the line\n"))

    def test_a_row_of_a_table_may_be_long_in_markdown_only(self):
        self.add("a.md", "| " + "x" * 121 + " |\n")
        self.add("a.c", "| " + "x" * 121 + " |\n")
        self.assertEqual(self.check("a.md"), (0, ""))
        self.assertEqual(self.check("a.c", "a.md")[0], 1)

    def test_other_files_are_not_asked(self):
        self.add("hashes.txt", "x" * 200 + "\n")
        self.add("a b.c", "int a;\n")
        self.assertEqual(self.check("a b.c"), (0, ""))


if __name__ == "__main__":
    unittest.main()
