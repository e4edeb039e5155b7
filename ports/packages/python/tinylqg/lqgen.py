# SPDX-License-Identifier: MIT
"""Where the generator, the headers and the sources are, and how the generator is run."""

import os
import subprocess
import sys
from pathlib import Path

from .errors import DesignError
from .names import name_in
from .result import load

FOLDER = Path(__file__).resolve().parent


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
    command = [str(lqgen_path()), "-o", str(folder), "--only", "h,test,json", "--quiet", *options, "--", str(design)]
    run = subprocess.run(
        command, capture_output=True, text=True, encoding="utf-8", errors="backslashreplace", check=False
    )
    if run.returncode == 3:
        raise OSError(run.stderr.strip())
    if run.returncode != 0:
        raise DesignError(run.stderr.strip() or f"lqgen ended with the status {run.returncode}")
    return load(Path(folder) / (name_in(design) + ".json"))


def main():
    """The command `lqgen`: this process becomes the program, with its arguments, streams and exit status."""
    os.execv(lqgen_path(), ["lqgen", *sys.argv[1:]])
