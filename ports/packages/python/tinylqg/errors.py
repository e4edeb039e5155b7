# SPDX-License-Identifier: MIT
"""What goes wrong, in one sentence: what was expected, and what was found."""

from contextlib import contextmanager

LONGEST = 300  # characters of a foreign text in a message


class DesignError(ValueError):
    """A plant, a number or a file cannot be what it has to be."""


def shown(text):
    """A foreign text as a message can have it: on one line, without control characters, not for ever."""
    printable = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in str(text)[: LONGEST + 1])
    return printable if len(printable) <= LONGEST else printable[:LONGEST] + "…"


def expected(where, what, found):
    """The error of `where`, as lqgen words it."""
    return DesignError(f"{shown(where)}: expected {what}, found {shown(found)}")


def needs(package, what, extra):
    """The error of a package that is not there."""
    return ImportError(f"{what} needs {package}, which is not installed: pip install 'tinylqg[{extra}]'")


@contextmanager
def refusing(where, what):
    """Around what reads a foreign file: whatever it makes the readers stumble over is a DesignError. A file that cannot
    be read at all stays an OSError."""
    try:
        yield
    except (DesignError, ImportError):
        raise
    except Exception as problem:
        if isinstance(problem, OSError) and problem.errno is not None:
            raise
        raise expected(where, what, f"one that cannot be read ({type(problem).__name__}: {problem})") from None
