# SPDX-License-Identifier: MIT
"""layout.py and licences.py: what they find, and what they leave alone."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
CLANG_FORMAT = sys.argv.pop(1)
LICENCE = "// SPDX-License-Identifier: MIT\n"


class Sources(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        subprocess.run(["git", "init", "--quiet"], cwd=self.folder, check=True)
        for style in (".clang-format", "src/.clang-format"):
            self.write(style, (ROOT / style).read_text(encoding="utf-8"))

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        subprocess.run(["git", "add", name], cwd=self.folder, check=True)
        return path

    def run_script(self, script, *arguments):
        done = subprocess.run([sys.executable, "-B", HERE / script, *arguments], capture_output=True, text=True)
        return done.returncode, done.stdout

    def test_a_line_that_is_laid_out_in_another_way_is_named_and_mended(self):
        path = self.write("a.cpp", LICENCE + "int  a;\n")
        status, said = self.run_script("layout.py", CLANG_FORMAT, self.folder)
        self.assertEqual((status, said.split(" ")[0]), (1, "a.cpp:2:"))
        self.assertEqual(self.run_script("layout.py", "--fix", CLANG_FORMAT, self.folder), (0, ""))
        self.assertEqual(path.read_text(encoding="utf-8"), LICENCE + "int a;\n")

    def test_c_has_four_spaces_and_cpp_two(self):
        self.write("a.cpp", "int f() {\n  if (a)\n    return 1;\n  else\n    return 2;\n}\n")
        self.write("a.c", "int f(void)\n{\n    return 1;\n}\n")
        self.assertEqual(self.run_script("layout.py", CLANG_FORMAT, self.folder), (0, ""))

    def test_what_is_emitted_is_not_looked_at(self):
        self.write("test/golden/a.h", "int  a;\n")
        self.assertEqual(self.run_script("layout.py", CLANG_FORMAT, self.folder), (0, ""))
        self.assertEqual(self.run_script("licences.py", self.folder), (0, ""))

    def test_another_version_is_told_and_nothing_is_checked(self):
        self.write("a.cpp", "int  a;\n")
        status, said = self.run_script("layout.py", "/bin/echo", self.folder)
        self.assertEqual((status, said.split(":")[0]), (0, "Not checked"))

    def test_a_source_without_its_licence_is_named(self):
        self.write("a.py", "#!/usr/bin/env python3\n# SPDX-License-Identifier: MIT\n")
        self.write("a.txt", "text\n")
        self.assertEqual(self.run_script("licences.py", self.folder), (0, ""))
        self.write("b.c", "int a;\n")
        status, said = self.run_script("licences.py", self.folder)
        self.assertEqual((status, said.split(" ")[0]), (1, "b.c:1:"))


if __name__ == "__main__":
    unittest.main()
