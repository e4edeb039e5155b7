# SPDX-License-Identifier: MIT
"""The emitted header as a shared library of this machine, called by ctypes: the emitted code itself."""

import ctypes
import subprocess
import tempfile
from functools import lru_cache
from pathlib import Path

from .errors import DesignError
from .kind import Kind
from .lqgen import include_dir, run_lqgen, source_dir
from .result import result_of

# The calls of a sample; `further` is r or NULL, of an estimator alone what acts. All numbers are those of the target:
# GCC 12's vectorizer makes nothing of (double)(float)y.
SOURCE = """#include <stddef.h>
#include "{name}.h"

size_t controller_size(void);
void controller_init(void *state);
unsigned controller_step(void *state, const {real} *y, const {real} *further, {real} *u, {real} *x);

size_t controller_size(void)
{{
    return {size};
}}

void controller_init(void *state)
{{
    (void)state;
    {init}
}}

unsigned controller_step(void *state, const {real} *y, const {real} *further, {real} *u, {real} *x)
{{
    {self}
    lqg_status_t status = LQG_OK;

    (void)state;
    for (int i = 0; i < {taken} && further != NULL; i++) {{
        {target}[i] = further[i];
    }}
    {calls}
    return status;
}}
"""
COPY = "for (int i = 0; i < {nx}; i++) {{ x[i] = {source}[i]; }}"
FLAGS = ("-std=c99", "-O2", "-fPIC", "-shared")


class Compiled:
    """The state of a controller, and the library that works on it."""

    def __init__(self, design, command):
        self.library, self.sizes, self.real = library_of(design, tuple(command))
        doubles = -(-self.library.controller_size() // ctypes.sizeof(ctypes.c_double))
        self.state = (ctypes.c_double * max(doubles, 1))()
        self.reset()

    def reset(self):
        self.library.controller_init(self.state)

    def numbers(self, values):
        return (self.real * max(len(values), 1))(*values)

    def step(self, measured, further):
        given = self.numbers(further) if further else None
        u, x = self.numbers([0.0] * self.sizes.inputs), self.numbers([0.0] * self.sizes.states)
        status = self.library.controller_step(self.state, self.numbers(measured), given, u, x)
        return u[: self.sizes.inputs], x[:], status

    def close(self):
        """A library stays loaded until the process ends: other controllers of the design use it."""


@lru_cache(maxsize=None)
def library_of(design, command):
    """The shared library of a design, its sizes and its type of numbers. Its folder is gone as soon as it is loaded."""
    with tempfile.TemporaryDirectory() as folder:
        run_lqgen(
            *("-o", folder, "--only", "h,json", "--quiet", "--", "-"),
            text=design.text,
            folder=design.folder,
            where=design.where,
        )
        header = Path(folder, design.name + ".h").read_text(encoding="utf-8")
        result = result_of(design.name, Path(folder, design.name + ".json").read_bytes())
        source = Path(folder, "controller.c")
        source.write_text(source_of(design.name, header, result), encoding="utf-8")
        file = Path(folder, "controller.so")
        compile_library([*command, *FLAGS, *switches(result)], folder, source, file, calls_library(result))
        library = ctypes.CDLL(str(file))
    library.controller_size.restype = ctypes.c_size_t
    library.controller_step.restype = ctypes.c_uint
    return library, Kind(result), {"float": ctypes.c_float, "double": ctypes.c_double}[result.code.real]


def calls_library(result):
    """In the compact style, and where limits are foreseen."""
    return result.code.style == "compact" or "limits" in result


def switches(result):
    """What the library and a header that calls it have to agree in."""
    if not calls_library(result):
        return []
    return ["-DLQG_REAL_DOUBLE"] * (result.code.real == "double") + ["-DLQG_FUSED"] * (
        result.code.arithmetic == "fused"
    )


def compile_library(command, folder, source, library, with_library):
    sources = sorted(source_dir().glob("*.c")) if with_library else []
    words = [*command, f"-I{include_dir()}", f"-I{folder}", str(source), *map(str, sources), "-o", str(library), "-lm"]
    try:
        run = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    except OSError as problem:
        raise OSError(problem.errno, f"the C compiler cannot be run: {problem.strerror}", command[0]) from None
    if run.returncode != 0:
        raise DesignError(f"{' '.join(command)}: the emitted header does not compile here:\n{run.stderr.strip()}")


def source_of(name, header, result):
    """The functions above around the header's own."""
    kind = Kind(result)
    has_state = f"void {name}_init(" in header
    is_linear = f" {name}_advance(" in header
    keeps_x = is_linear or f" {name}_estimate(" not in header
    calls = calls_of(name, kind, is_linear, keeps_x, has_state)
    takes_r = kind.references > 0 and not kind.is_estimator
    words = {
        "name": name,
        "real": result.code.real,
        "size": f"sizeof({name}_t)" if has_state else "0",
        "init": f"{name}_init(state);" if has_state else "",
        "self": f"{name}_t *const self = state;" if has_state else "",
        "nx": kind.states,
        "taken": kind.references if takes_r else kind.inputs if kind.is_estimator else 0,
        "target": "self->r" if takes_r else "u",
    }
    return SOURCE.format(calls="\n    ".join(calls).format(**words), **words)


def calls_of(name, kind, is_linear, keeps_x, has_state):
    """A sample in the order of its form, as firmware takes it."""
    if not kind.has_filter:
        first = "self, " if has_state else ""
        return [f"status |= {name}_control({first}y, u);", copy_of("y")]
    if is_linear:
        y, late = ("", ", y") if kind.is_predictor else ("y, ", "")
        return [
            f"status |= {name}_control(self, {y}u);",
            f"{name}_estimate(self, x);",
            f"status |= {name}_advance(self{late});",
        ]
    read = copy_of("self->x") if keeps_x else f"{name}_estimate(self, x);"
    hear, act = f"status |= {name}_update(self, y);", read
    if not kind.is_estimator:
        act += f" status |= {name}_control(self, u);"
    predict = f"status |= {name}_predict(self{', u' if kind.inputs else ''});"
    return [act, hear, predict] if kind.is_predictor else [hear, act, predict]


def copy_of(source):
    return COPY.replace("{source}", source)
