# SPDX-License-Identifier: MIT
"""layout.py [--fix] CLANG_FORMAT ROOT [FILE…]: fails where a C or C++ source (of FILE, if there are any) is not laid
out as clang-format does it with ROOT/.clang-format (C++) or ROOT/src/.clang-format (C); --fix lays it out. What is
emitted, headers whose columns are aligned by hand, and sketches are not looked at. Other versions than VERSION break
some lines elsewhere: with them nothing is checked, and that is said."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

VERSION = "19."
STYLES = {".cpp": ".clang-format", ".hpp": ".clang-format", ".c": "src/.clang-format", ".h": "src/.clang-format"}
BY_HAND = ("include/lqg/", "ports/packages/arduino/", "test/golden/")


def sources(root, chosen):
    command = ["git", "-c", f"safe.directory={root.resolve()}", "ls-files", "-z", "--", *chosen]
    listed = subprocess.run(command, cwd=root, check=True, capture_output=True).stdout.decode()
    return [
        name
        for name in listed.split("\0")
        if Path(name).suffix in STYLES and not name.startswith(BY_HAND) and (root / name).is_file()
    ]


def laid_out(program, root, name):
    style = root / STYLES[Path(name).suffix]
    return subprocess.run([program, f"--style=file:{style}", name], cwd=root, check=True, capture_output=True).stdout


def first_difference(old, new):
    pairs = zip(old.split(b"\n"), new.split(b"\n"))
    return next((number for number, (a, b) in enumerate(pairs, 1) if a != b), 1)


def main():
    arguments = sys.argv[1:]
    fix = arguments[0] == "--fix"
    program, root, *chosen = arguments[fix:]
    root = Path(root)
    try:
        version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout
    except OSError:
        version = f"no {program}"
    if f"version {VERSION}" not in version:
        print(f"Not checked: needs clang-format {VERSION}x, found {version.strip()}: pip install clang-format==19.1.7")
        return False
    names = sources(root, chosen)
    failed = False
    with ThreadPoolExecutor() as pool:
        for name, new in zip(names, pool.map(lambda name: laid_out(program, root, name), names)):
            old = (root / name).read_bytes()
            if old != new and fix:
                (root / name).write_bytes(new)
            elif old != new:
                print(
                    f"{name}:{first_difference(old, new)}: clang-format lays this out in another way: "
                    "python3 test/github/layout.py --fix clang-format ."
                )
                failed = True
    return failed


sys.exit(main())
