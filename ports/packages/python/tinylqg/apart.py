# SPDX-License-Identifier: MIT
"""The readers of .mat files are compiled C, which a damaged file can crash: they run in a process of their own."""

import pickle
import subprocess
import sys

from .errors import DesignError, expected

LONGEST = 120  # s
CHILD = "import sys; sys.path[:] = {!r}; from tinylqg import apart; apart.answer()"


def variables(path, data):
    """`mat_file.variables_in`, or a DesignError where it does not survive."""
    command = [sys.executable, "-c", CHILD.format(sys.path), str(path)]
    try:
        run = subprocess.run(command, input=data, capture_output=True, timeout=LONGEST, check=False)
    except subprocess.TimeoutExpired:
        raise expected(path, "a .mat file", f"one that takes more than {LONGEST} s to read") from None
    if run.returncode != 0:
        raise expected(path, "a .mat file", f"one that its reader does not survive (status {run.returncode})")
    outcome = pickle.loads(run.stdout)
    if isinstance(outcome, Exception):
        raise outcome
    return outcome


def answer():
    """What the process does: from a file at standard input to variables, or the reason why not."""
    from .mat_file import variables_in

    try:
        outcome = variables_in(sys.argv[1], sys.stdin.buffer.read())
    except (DesignError, ImportError) as problem:
        outcome = problem
    sys.stdout.buffer.write(pickle.dumps(outcome))
