# SPDX-License-Identifier: MIT
"""Where the generator, the headers and the sources are, and how the generator is run."""

import os
import re
import subprocess
import sys
from pathlib import Path

from .errors import DesignError
from .names import name_in
from .result import load

FOLDER = Path(__file__).resolve().parent
STANDARD_INPUT = "standard input"  # as lqgen calls it


def lqgen_path():
    """The program lqgen of this package."""
    return FOLDER / "bin" / "lqgen"


def include_dir():
    """What goes on the compiler's include path: it holds lqg/*.h."""
    return FOLDER / "include"


def source_dir():
    """The C library's sources, for controllers in the compact style: compile all *.c in it."""
    return FOLDER / "src"


def generate(design, folder=".", *options):
    """Runs lqgen on the file `design`, so that `folder` gets NAME.h, NAME_test.c and NAME.json, and loads the last.

    `options` go to lqgen: "--style", "compact". What lqgen refuses is a DesignError with all its lines; a file that
    cannot be read or written an OSError.
    """
    run_lqgen("-o", str(folder), "--only", "h,test,json", "--quiet", *options, "--", str(design))
    return load(Path(folder) / (name_in(design) + ".json"))


def run_lqgen(*arguments, text=None, folder=None, where=STANDARD_INPUT):
    """lqgen with these arguments in `folder`: what it printed on standard output and on standard error. `text` is its
    standard input, the design file; what it says of it names the file `where`, or no file where that is ""."""
    run = subprocess.run(
        [str(lqgen_path()), *arguments],
        input=text,
        stdin=subprocess.DEVNULL if text is None else None,
        cwd=folder,
        capture_output=True,
        text=True,
        encoding="utf-8",
        errors="backslashreplace",
        check=False,
    )
    said = located(run.stderr, where)
    if run.returncode == 3:
        raise OSError(said.strip())
    if run.returncode != 0:
        raise DesignError(said.strip() or f"lqgen ended with the status {run.returncode}")
    return run.stdout, said


def located(said, where):
    """lqgen's lines with `where` in place of its standard input; a text that is in no file has no places, either."""
    if where:
        return re.sub(rf"^{STANDARD_INPUT}:", lambda _: f"{where}:", said, flags=re.MULTILINE)
    return re.sub(rf"^{STANDARD_INPUT}:(\d+:\d+:)? ", "", said, flags=re.MULTILINE)


def main():
    """The command `lqgen`: this process becomes the program, with its arguments, streams and exit status."""
    os.execv(lqgen_path(), ["lqgen", *sys.argv[1:]])
