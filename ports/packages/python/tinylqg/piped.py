# SPDX-License-Identifier: MIT
"""The emitted controller behind the pipe of `lqgen run`, where no C compiler is."""

import subprocess
import tempfile
import weakref
from pathlib import Path

from .errors import DesignError
from .kind import Kind
from .lqgen import lqgen_path


class Piped:
    """A process of lqgen that answers a line by a line."""

    def __init__(self, design):
        self.kind = Kind(design.solve())
        self.errors = tempfile.TemporaryFile()
        self.folder = tempfile.TemporaryDirectory()
        file = Path(self.folder.name, design.name + ".toml")
        file.write_bytes(alone(design).text.encode("utf-8"))
        self.process = subprocess.Popen(
            [str(lqgen_path()), "run", "--quiet", "--", str(file)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self.errors,
            text=True,
            bufsize=1,
        )
        self.end = weakref.finalize(self, ended, self.process, self.errors, self.folder)

    def tell(self, line):
        try:
            self.process.stdin.write(line + "\n")
            self.process.stdin.flush()
        except (OSError, ValueError):
            raise self.reason() from None

    def reason(self):
        if not self.end.alive:
            return DesignError("this controller is closed")
        self.process.wait()
        self.errors.seek(0)
        return DesignError(self.errors.read().decode("utf-8", "backslashreplace").strip() or "lqgen run has ended")

    def step(self, measured, further):
        self.tell(" ".join(map(repr, [*measured, *further])))
        words = self.process.stdout.readline().split()
        if not words:
            raise self.reason()
        inputs = 0 if self.kind.is_estimator else self.kind.inputs
        values = [float(word) for word in words[:-1]]
        return values[:inputs], values[inputs:], int(words[-1])

    def reset(self):
        self.tell("reset")

    def close(self):
        self.end()


def alone(design):
    """The design without scenarios, whose files lie beside it, and without what is required of it in them."""
    return design.replace(scenario=None, require=None) if design.scenarios else design


def ended(process, errors, folder):
    """The process has ended when its input has."""
    for stream in (process.stdin, process.stdout):
        try:
            stream.close()
        except OSError:
            pass
    process.wait()
    errors.close()
    folder.cleanup()
