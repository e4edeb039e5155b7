#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Honest samples of a controller in closed loop with its plant: none may be taken for a fault; honest.c is the loop.

    honest.py <build> DESIGN.toml STYLE [--samples N] [--lap N] [--spike SIGMA]

A lap starts at x0 and a draw from P0, and has a silence of 10 s, or of the half, a quarter …, until the loop survives
it. A lap has --lap samples, and at least three times those 10 s. A gate of the design's own, kalman.gate, may leave out
what its σ says of normal numbers. --spike gives the design another threshold. Everything is written below the current
folder. CC is the compiler.

Exit status 0: nothing was taken for a fault; 1: something was; 2: something is not there, or lqgen refuses the design.
"""

import argparse
import math
import sys
import tomllib
from pathlib import Path

from closed_loop import array, build_program, generate, members, plant_of, plant_text, run, square_root, table

SILENCE = 10  # s


def start_of(plant, kalman: dict):
    """x0, and the factor of P0: a list is the diagonal, and of the inputs on their way nothing is uncertain."""
    nx, known = len(plant["A"]), len(plant["states"])
    own = kalman.get("initial_covariance", [1.0] * known)
    covariance = [[0.0] * nx for _ in range(nx)]
    for i in range(known):
        for j in range(known):
            covariance[i][j] = own[i][j] if isinstance(own[i], list) else own[i] * (i == j)
    start = list(kalman.get("initial_state", []))
    return start + [0.0] * (nx - len(start)), square_root(covariance)


def honest_text(plant, kalman: dict, header: str, lap: int) -> str:
    """What honest.c has to know beside closed_loop.h."""
    silence = math.floor(SILENCE / plant["sample_time"] + 0.5)
    start, factor = start_of(plant, kalman)
    share = math.erfc(kalman["gate"] / math.sqrt(2)) if "gate" in kalman else 0.0
    text = f"enum {{ LAP = {max(lap, 3 * silence)}, LONGEST_SILENCE = {silence} }};\n"
    text += f"#define GATED_SHARE {share!r}\n" + array("start", [start]) + array("start_factor", factor)
    return text + table("counters", [(name, kind) for name, kind in members(header) if kind == "unsigned long"])


def with_spike(file: Path, sigma: str) -> Path:
    """The same design with another threshold."""
    variant = Path("variant.toml").resolve()
    variant.write_text(file.read_text().replace("[kalman]", f"[kalman]\nspike = {sigma}", 1))
    return variant


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("design", type=Path)
    parser.add_argument("style", choices=["unrolled", "compact"])
    parser.add_argument("--samples", type=int, default=1000000)
    parser.add_argument("--lap", type=int, default=5000)
    parser.add_argument("--spike")
    given = parser.parse_args()
    file = given.design.resolve()
    if given.spike:
        file = with_spike(file, given.spike)
    design = generate(given.build.resolve(), file, given.style)
    if not design:
        return 2
    if "kalman" not in design:
        print("it has no estimator: nothing is asked")
        return 0
    keys, header = tomllib.loads(file.read_text()), Path(design["name"] + ".h").read_text()
    text = plant_text(design, keys.get("limits", {}), header)
    build_program(design, text + honest_text(plant_of(design), keys.get("kalman", {}), header, given.lap), "honest")
    done = run("./honest", given.samples)
    print(done.stdout, end="")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
