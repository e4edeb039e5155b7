# SPDX-License-Identifier: MIT
"""python -m tinylqg: the command line of what lqgen itself does not do."""

import argparse
import os
import sys
from pathlib import Path

from . import __version__, include_dir, lqgen_path, source_dir
from .design_file import design_text
from .errors import DesignError, expected
from .mat import read_mat
from .result import load

WRITTEN, WRONG, UNREADABLE = 0, 2, 3  # lqgen's own


def import_mat(arguments):
    """MATLAB's matrices to a design file."""
    keys = read_mat(arguments.file, arguments.variable)
    for key in ("name", "brief", "sample_time", "delay"):
        if getattr(arguments, key) is not None:
            keys[key] = getattr(arguments, key)
    keys.setdefault("name", Path(arguments.file).stem)
    text = design_text(**keys).encode("utf-8")
    if arguments.output == "-":
        sys.stdout.buffer.write(text)
        return
    write(Path(arguments.output or keys["name"] + ".toml"), text, arguments.force)


def write(output, text, force):
    """A new file, and no link's target; `force` writes to what is there."""
    try:
        with output.open("wb" if force else "xb") as file:
            file.write(text)
    except FileExistsError:
        raise expected(
            output, "a file that is not there yet", "one that somebody may have edited; --force replaces it"
        ) from None


def export_mat(arguments):
    """NAME.json to MATLAB's matrices."""
    load(arguments.file).save_mat(arguments.output or Path(arguments.file).with_suffix(".mat"))


def print_path(arguments):
    print({"include": include_dir, "src": source_dir, "lqgen": lqgen_path}[arguments.command]())


def parser():
    top = argparse.ArgumentParser(prog="python -m tinylqg", description="What stands around lqgen.")
    top.add_argument("--version", action="version", version=__version__)
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    reader = commands.add_parser("import", help="make a design file of a .mat file (MATLAB, Octave, Scilab)")
    reader.add_argument("file", metavar="PLANT.mat")
    reader.add_argument("-o", dest="output", metavar="DESIGN.toml", help="default: NAME.toml; -: standard output")
    reader.add_argument("--name", help="name of the design; default: the variable `name`, or the file's name")
    reader.add_argument("--brief", help="one line about it")
    reader.add_argument("--sample-time", type=float, metavar="T", help="period of the loop in s")
    reader.add_argument("--delay", type=float, metavar="T", help="s from sampling to the input taking effect")
    reader.add_argument("--variable", metavar="S", help="the structure that has the matrices as its fields")
    reader.add_argument("--force", action="store_true", help="replace a design file that is there")
    reader.set_defaults(run=import_mat)

    writer = commands.add_parser("export", help="make a .mat file of the NAME.json that lqgen wrote")
    writer.add_argument("file", metavar="NAME.json")
    writer.add_argument("-o", dest="output", metavar="NAME.mat", help="default: NAME.mat beside it")
    writer.set_defaults(run=export_mat)

    for name, what in (
        ("include", "folder for the compiler's include path"),
        ("src", "folder of the C library's sources"),
        ("lqgen", "program"),
    ):
        commands.add_parser(name, help=f"print the {what}").set_defaults(run=print_path)
    return top


def main(words=None):
    arguments = parser().parse_args(words)
    try:
        arguments.run(arguments)
    except DesignError as error:
        print(error, file=sys.stderr)
        return WRONG
    except ImportError as error:
        print(error, file=sys.stderr)
        return UNREADABLE
    except OSError as error:
        reason = os.strerror(error.errno) if error.errno else str(error)
        print(f"{error.filename or arguments.file}: {reason}", file=sys.stderr)
        return UNREADABLE
    return WRITTEN


if __name__ == "__main__":
    sys.exit(main())
