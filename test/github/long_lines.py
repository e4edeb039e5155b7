# SPDX-License-Identifier: MIT
"""long_lines.py ROOT LIST: counts the lines of more than 120 characters in all tracked text files. Fails where a file
has more of them than LIST allows: `NUMBER PATH` in each of its lines, below the reason as a comment. Rows of tables in
Markdown cannot be broken and may be longer."""

import subprocess
import sys
from pathlib import Path

LIMIT = 120


def tracked(root):
    listed = subprocess.run(
        ["git", "-c", f"safe.directory={root.resolve()}", "ls-files", "-z"], cwd=root, check=True, capture_output=True
    ).stdout.decode()
    return [name for name in listed.split("\0") if name and (root / name).is_file()]


def long_lines(path):
    """Their numbers; none of a file that is no text."""
    try:
        lines = path.read_text(encoding="utf-8").split("\n")
    except UnicodeDecodeError:
        return []
    is_row = path.suffix == ".md"
    return [
        number
        for number, line in enumerate(lines, 1)
        if len(line) > LIMIT and not (is_row and line.lstrip().startswith("|"))
    ]


def exceptions(text):
    rows = (line.split(maxsplit=1) for line in text.splitlines() if line and not line.startswith("#"))
    return {path: int(number) for number, path in rows}


def main():
    root, allowed = Path(sys.argv[1]), exceptions(Path(sys.argv[2]).read_text(encoding="utf-8"))
    failed = False
    for name in tracked(root):
        found, most = long_lines(root / name), allowed.get(name, 0)
        if len(found) > most:
            print(
                f"{name}:{found[-1]}: expected at most {most} lines of more than {LIMIT} characters, "
                f"found {len(found)}: break them"
            )
            failed = True
        elif len(found) < most:
            print(f"note: {name} has {len(found)} long lines: {sys.argv[2]} may say so")
    return failed


sys.exit(main())
