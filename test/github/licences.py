# SPDX-License-Identifier: MIT
"""licences.py ROOT: fails where a source does not name its licence in its first two lines, as SPDX has it. What lqgen
emits is the user's: templates and golden outputs name none."""

import subprocess
import sys
from pathlib import Path

LINE = "SPDX-License-Identifier: MIT"
SUFFIXES = {".c", ".h", ".cpp", ".hpp", ".ino", ".py", ".sh", ".cmake"}
EMITTED = ("test/golden/",)


def main():
    root = Path(sys.argv[1])
    listed = subprocess.run(
        ["git", "-c", f"safe.directory={root.resolve()}", "ls-files", "-z"], cwd=root, check=True, capture_output=True
    ).stdout.decode()
    failed = False
    for name in listed.split("\0"):
        path = root / name
        is_source = path.suffix in SUFFIXES or path.name == "CMakeLists.txt"
        if not is_source or name.startswith(EMITTED) or not path.is_file():
            continue
        if not any(LINE in line for line in path.read_text(encoding="utf-8").split("\n")[:2]):
            print(f"{name}:1: expected a comment with `{LINE}` in the first two lines, found none")
            failed = True
    return failed


sys.exit(main())
