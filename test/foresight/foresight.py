#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The compiled header of a design whose limits are foreseen, in random states and from random starts; foresight.c is
the program.

    foresight.py <build> DESIGN.toml float|double conditions|starts NUMBER [--hasty]

conditions: every answer is the optimum by its own conditions, and no sample needs more changes than the header allows.
starts: the loop with its plant settles from as many starts as it does with the law clipped, or more; it says how many.
--hasty allows the header three changes: then some states are given up. Everything is written below the current folder.
CC is the compiler.

Exit status 0: it is so; 1: it is not; 2: something is not there, or lqgen refuses the design.
"""

import argparse
import random
import re
import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "flips"))
from closed_loop import array, build_program, generate, plant_text, product, run, solved, square_root, transposed

HERE = Path(__file__).resolve().parent
DRAWS = 1000
INFINITE = 1e300  # what the JSON file has in place of a limit that there is not


def limits_of(quantity) -> tuple:
    low, high = quantity.get("low"), quantity.get("high")
    return (-INFINITE if low is None else low), (INFINITE if high is None else high)


def share_of_limits(design, x) -> float:
    """How far the law goes with the limited quantities, at most, as a share of their limits."""
    rows = [[-k for k in row] for row in design["lqr"]["K"]] + design["limits"]["F"]
    share = 0.0
    for row, quantity in zip(rows, design["limits"]["quantities"]):
        z = sum(a * b for a, b in zip(row, x))
        limit = abs(limits_of(quantity)[z > 0])
        share = max(share, abs(z) / limit if limit else 0.0)
    return share


def start_factor(design):
    """Of normal numbers makes states that are equally dear in all directions; in the median the law alone then goes as
    far as a limit."""
    factor = square_root(design["lqr"]["X"])
    size = len(factor)
    columns = [solved(transposed(factor), [float(i == j) for i in range(size)]) for j in range(size)]
    spread, draws = transposed(columns), random.Random(1)
    shares = []
    for _ in range(DRAWS):
        normal = [[draws.gauss(0, 1)] for _ in range(size)]
        shares.append(share_of_limits(design, [row[0] for row in product(spread, normal)]))
    median = sorted(shares)[DRAWS // 2]
    return [[entry / median for entry in row] for row in spread]


def foresight_text(design, limits) -> str:
    """What foresight.c has to know beside closed_loop.h."""
    name, lqr, nx = design["name"].upper(), design["lqr"], len(design["plant"]["A"])
    if len(lqr["X"]) != nx:
        print("expected a law of the plant's states, and of references")
        sys.exit(2)
    factor = start_factor(design)
    typical = [sum(entry**2 for entry in row) ** 0.5 for row in factor]
    text = f"#define LAW_LIMITS {name}_LIMITS\nenum {{ ROWS = {name}_ROWS, NR = {len(lqr.get('Nx', [[]])[0])} }};\n"
    text += array("start_factor", factor) + array("typical", [typical]) + array("Nx", lqr.get("Nx", []))
    text += array("Nu", lqr.get("Nu", [])) + array("K", lqr["K"]) + array("X", lqr["X"])
    limited = dict(soft_states(design, limits))
    text += array("state_limits", [limited.get(name, (-INFINITE, INFINITE)) for name in design["plant"]["states"]])
    if lqr.get("Nx"):
        text += "#define HAS_REFERENCES\n"
    if "u_rate" in limits:
        text += "#define LIMITS_CHANGE\n"
        text += array("u_change", [[rate * design["plant"]["sample_time"] for rate in limits["u_rate"]]])
    return text


def soft_states(design, limits):
    """Names as in the plant, and (low, high)."""
    for key, range_ in limits.get("states", {}).items():
        name = next(state for state in design["plant"]["states"] if state == key or state.split(" [")[0] == key)
        yield name, tuple(range_) if isinstance(range_, list) else (-range_, range_)


def prepare(build: Path, file: Path, real: str, change=("", ""), program="foresight", folder=HERE):
    """The design as the JSON file has it, its limits as the design file has them; ./foresight is there, or another
    program of another folder. `change`: in the header, a pattern and what comes in its place."""
    design = generate(build, file, "unrolled", "--real", real)
    if not design:
        sys.exit(2)
    limits = tomllib.loads(file.read_text())["limits"]
    file_of_header = Path(design["name"] + ".h")
    header = file_of_header.read_text()
    if change[0]:
        changed, count = re.subn(*change, header)
        assert count == 1, f"expected one {change[0]}"
        file_of_header.write_text(changed)
    text = plant_text(design, limits, header) + foresight_text(design, limits)
    build_program(design, text, program, folder)
    return design, limits


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("design", type=Path)
    parser.add_argument("real", choices=["float", "double"])
    parser.add_argument("task", choices=["conditions", "starts"])
    parser.add_argument("number", type=int)
    parser.add_argument("--hasty", action="store_true")
    given = parser.parse_args()
    change = (r"(_ROWS, )\d+u,", r"\g<1>3u,") if given.hasty else ("", "")
    prepare(given.build.resolve(), given.design.resolve(), given.real, change)
    done = run("./foresight", given.task, given.number)
    print(done.stdout, end="")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
