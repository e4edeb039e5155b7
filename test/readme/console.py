# SPDX-License-Identifier: MIT
"""console.py PAGE LQGEN DESIGN…: runs the commands of a page's ```console blocks, one after the other in one folder
with these designs, and fails where a command does not print the lines below it. A line … stands for any lines."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def steps(page):
    """(line, command, expected lines) of every command."""
    inside, found = False, []
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if line.startswith("```"):
            inside = line == "```console"
        elif inside and line.startswith("$ "):
            found.append((number, line[2:], []))
        elif inside:
            found[-1][2].append(line)
    return found


def printed(command, folder, environment):
    """What the command prints, standard error first. Standard output is a terminal, to which lqgen prints more."""
    reading, terminal = os.openpty()
    with subprocess.Popen(
        ["sh", "-c", command],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=terminal,
        stderr=subprocess.PIPE,
    ) as process:
        os.close(terminal)
        out = b""
        try:
            while piece := os.read(reading, 65536):
                out += piece
        except OSError:  # the terminal's end
            pass
        os.close(reading)
        return (process.stderr.read() + out).decode().replace("\r\n", "\n")


def matches(expected, text):
    pattern = "".join(r"(?:.*\n)*?" if line == "…" else re.escape(line) + "\n" for line in expected)
    return re.fullmatch(pattern, text) is not None


def main():
    page, lqgen, designs = Path(sys.argv[1]), Path(sys.argv[2]).resolve(), sys.argv[3:]
    environment = {**os.environ, "PATH": f"{lqgen.parent}{os.pathsep}{os.environ['PATH']}"}
    commands, failed = steps(page), False
    with tempfile.TemporaryDirectory() as folder:
        for design in designs:
            shutil.copy(design, folder)
        for number, command, expected in commands:
            text = printed(command, folder, environment)
            if not matches(expected, text):
                print(f"{page}:{number}: `{command}` printed\n{text}")
                failed = True
    if not commands:
        print(f"{page}: expected blocks ```console, found none")
    return failed or not commands


sys.exit(main())
