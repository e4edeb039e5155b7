# SPDX-License-Identifier: MIT
"""The package's page: its blocks run as printed, those of one chapter in order, in one folder, each by its program."""

import os
import re
import subprocess
import sys
from pathlib import Path

from designs import SOURCE

PAGE = SOURCE / "ports" / "packages" / "python" / "README.md"

PROGRAMS = {
    "python": [sys.executable, "{file}"],
    "sh": ["bash", "-eu", "{file}"],
    "octave": ["octave-cli", "--norc", "--quiet", "{file}"],
    "scilab": ["scilab-cli", "-nb", "-quit", "-f", "{file}"],
}


def chapter(title):
    text = PAGE.read_text(encoding="utf-8")
    found = re.search(rf"^## {re.escape(title)}\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    return re.findall(r"^```(\w+)\n(.*?)^```", found[1], re.MULTILINE | re.DOTALL)


def as_script(language, block):
    """Scilab stays at its prompt after an error, and its exit status does not tell."""
    if language != "scilab":
        return block
    return f"try\n{block}\nmprintf('no error\\n');\ncatch\nmprintf('%s\\n', lasterror());\nend\nexit(0)\n"


def run_chapter(title, *languages):
    """Runs the blocks of a chapter, which have to be in these languages, in the current folder."""
    blocks = chapter(title)
    assert [language for language, _ in blocks] == list(languages), blocks
    environment = {**os.environ, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
    for language, block in blocks:
        Path("block").write_text(as_script(language, block), encoding="utf-8")
        done = subprocess.run(
            [word.format(file="block") for word in PROGRAMS[language]],
            env=environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
        output = done.stdout + done.stderr
        assert done.returncode == 0, output
        assert language != "scilab" or "no error" in output, output
