# SPDX-License-Identifier: MIT
"""new_lines.py FILE…: fails where a line that is about to be committed in one of these files has more than 120
characters. Rows of tables in Markdown cannot be broken and may be longer."""

import re
import subprocess
import sys

LIMIT = 120


def new_lines(paths):
    """(path, number, text) of every line that `git commit` would add."""
    options = ["--cached", "--unified=0", "--no-color", "--no-ext-diff", "--no-prefix"]
    command = ["git", "diff", *options, "--", *paths]
    diff = subprocess.run(command, check=True, capture_output=True).stdout.decode(errors="replace")
    path, number, left = None, 0, 0
    for line in diff.split("\n"):
        if left > 0 and line.startswith("+"):
            yield path, number, line[1:]
            number, left = number + 1, left - 1
        elif line.startswith("+++ "):
            path = line[4:].rstrip("\t")
        elif hunk := re.match(r"@@ -\S+ \+(\d+)(?:,(\d+))? @@", line):
            number, left = int(hunk[1]), int(hunk[2] or 1)


def main():
    failed = False
    for path, number, text in new_lines(sys.argv[1:]) if sys.argv[1:] else ():
        if len(text) > LIMIT and not (path.endswith(".md") and text.lstrip().startswith("|")):
            print(f"{path}:{number}: expected at most {LIMIT} characters, found {len(text)}: break the line")
            failed = True
    return failed


sys.exit(main())
