# SPDX-License-Identifier: MIT
"""The emitted controller at work, sample by sample, for simulators and notebooks."""

from __future__ import annotations

import os
import shlex
import shutil
from typing import Any, Optional, Sequence

from .compiled import Compiled
from .errors import DesignError, expected
from .kind import Kind
from .piped import Piped
from .result import array

# The bits of lqg/status.h.
STATUS = {
    "output_rejected": 1,
    "output_gated": 2,
    "innovation_not_positive": 4,
    "input_limited": 8,
    "state_reset": 16,
    "reference_not_finite": 32,
    "covariance_reset": 64,
    **{f"output_rejected_{i}": 0x100 << i for i in range(8)},
}


class Controller:
    """The controller of a design, with the numbers that it has on the target. `Design.controller()` makes one.

        with design.controller() as controller:
            for k in range(1000):
                u = controller.step(y, r)

    It holds a compiled library or a process: `close()`, or the end of `with`, gives that back.
    """

    def __init__(self, design, engine):
        self.design = design
        self.engine = engine
        self.kind = Kind(design.solve())
        self.forget()

    def forget(self):
        self.x = None
        self.status_bits = 0

    x: Any
    """x̂ that the last u was made of, an array of nx numbers, inputs on their way included; None before the first step.
    Without a filter it is the x that was given."""

    status_bits: int
    """Of the last step, the bits of lqg/status.h."""

    @property
    def status(self) -> tuple:
        """Of the last step: names such as "input_limited", "output_rejected" and, beside it, "output_rejected_0" for
        the output 0; from the seventh on outputs share a name. Empty: nothing to report."""
        return tuple(name for name, bit in STATUS.items() if self.status_bits & bit)

    def step(self, y: Sequence[float], r: Optional[Sequence[float]] = None, u: Optional[Sequence[float]] = None):
        """One sample: u, an array of nu numbers, within its limits.

        y : the ny outputs, a number where there is one; NaN or None is one that is missing. A design without a filter
            measures its states: then it is x, of nx numbers, inputs on their way included.
        r : the references, in the order of the outputs in `track` or `integral`. None: as before, at first 0
            or what the outputs are at the operating point.
        u : of an estimator alone, the inputs that act from now on. It gives back x̂.

        In filter form u depends on this y; in predictor form on those before, and u could be applied before y is there.
        Raises DesignError where sizes are wrong.
        """
        kind = self.kind
        measured = numbers(kind.measured, y, kind.measured_size)
        if kind.is_estimator:
            if r is not None:
                raise DesignError("r: an estimator alone follows nothing: expected none")
            further = numbers("u", () if u is None else u, kind.inputs) if kind.inputs else []
        elif u is not None:
            raise DesignError("u: the controller makes it: expected none; an estimator alone takes one")
        else:
            further = [] if r is None else numbers("r", r, kind.references)
        made, x, self.status_bits = self.engine.step(measured, further)
        self.x = array(x)
        return self.x if kind.is_estimator else array(made)

    def reset(self):
        """All as at the start: x̂ = x0, r = 0 or that of the operating point."""
        self.engine.reset()
        self.forget()

    def close(self):
        self.engine.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def numbers(what, values, count):
    """As doubles of Python; None is NaN."""
    if hasattr(values, "tolist"):
        values = values.tolist()
    if values is None or isinstance(values, (int, float)):
        values = [values]
    values = [item for value in values for item in (value if isinstance(value, list) else [value])]
    if len(values) != count:
        raise expected(what, f"{count} number{'s' if count != 1 else ''}", len(values))
    values = [float("nan") if value is None else value for value in values]
    if not all(isinstance(value, (int, float)) for value in values):
        raise expected(what, "numbers", repr(values))
    return [float(value) for value in values]


def compiler():
    """The words of the C compiler's command, or None."""
    words = shlex.split(os.environ.get("CC") or "cc")
    return words if words and shutil.which(words[0]) else None


def controller(design, compiled=None) -> Controller:
    command = compiler()
    if compiled and command is None:
        raise OSError("controller(compiled=True): expected a C compiler, CC or cc, found none")
    if compiled is False or command is None:
        return Controller(design, Piped(design))
    return Controller(design, Compiled(design, command))
