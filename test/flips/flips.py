#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Flips each bit of each number of a controller's state, one at a time, in closed loop with its plant; flips.c is the
loop.

    flips.py <build> DESIGN.toml|SEED STYLE [--sample N] [--list] [--deaf]

After NAME_RECOVERY_SAMPLES the loop has to be back where it would be without the flip, to what the noise explains. A
SEED is that of a random design. --sample N takes N flips, evenly. --list prints those that physics forbids to forget,
too. --deaf takes out of a straight-line header that a P that is none begins anew: then some are not forgotten.
Everything is written below the current folder. CC is the compiler.

Exit status 0: all flips are forgotten, or physics forbids it, or lqgen refuses a random design; 1: some are not; 2:
something is not there.
"""

import argparse
import math
import re
import sys
import tomllib
from pathlib import Path

from closed_loop import array, build_program, generate, members, plant_of, plant_text, run, stop, table

COUNTED = {"resets", "covariance_resets", "gated"}  # what was counted is not used
CALLERS = {"r"}  # written by the caller
LARGE = 1e30  # where a form without bounds computes no more


def flips_text(design, limits: dict, header: str) -> str:
    """What flips.c has to know beside closed_loop.h."""
    nx = len(plant_of(design)["A"])
    lasting = set(design["recovery"].get("lasting", []))
    text = array("within", [design["recovery"]["within"]])
    text += array("is_lasting", [[i in lasting for i in range(nx)]], "double")
    text += array("x_bound", [state_bounds(design)])
    has_limits = all(which in limits and all(map(math.isfinite, limits[which])) for which in ("u_min", "u_max"))
    text += f"enum {{ HAS_LIMITS = {int(has_limits)} }};\n"
    text += f"enum {{ RECOVERY_SAMPLES = {design['name'].upper()}_RECOVERY_SAMPLES }};\n"
    return text + table("members", [(name, kind) for name, kind in members(header) if name not in COUNTED | CALLERS])


def state_bounds(design) -> list:
    """How far the states can be before the controller begins anew."""
    if "compensator" in design:
        return [LARGE] * len(plant_of(design)["A"])
    bounds = design["numerics"]["bounds"]
    if "modes" not in design:
        return bounds["x"]
    return [sum(abs(t) * bound for t, bound in zip(row, bounds["z"])) for row in design["modes"]["T"]]


def random_design(build: Path, seed: str) -> Path:
    program = build / "test" / "flips" / "flips_random_design"
    if not program.exists():
        stop(f"Not found: {program}")
    design = Path(f"{seed}.toml").resolve()
    design.write_text(run(program, seed).stdout)
    return design


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("design")
    parser.add_argument("style", choices=["unrolled", "compact"])
    parser.add_argument("--sample", type=int, default=0)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--deaf", action="store_true")
    given = parser.parse_args()
    build, is_random = given.build.resolve(), given.design.isdigit()
    file = random_design(build, given.design) if is_random else Path(given.design).resolve()
    design = generate(build, file, given.style)
    if not design:
        if is_random:
            print(f"random design {given.design} is refused by lqgen")
        return 0 if is_random else 2
    if "samples" not in design.get("recovery", {}):
        print("no number of samples is promised")
        return 0
    file_of_header = Path(design["name"] + ".h")
    header = file_of_header.read_text()
    if given.deaf:
        file_of_header.write_text(re.sub(r"(status|outcome) = \w+_recover\(self, status\);", "", header))
    limits = tomllib.loads(file.read_text()).get("limits", {})
    build_program(design, plant_text(design, limits, header) + flips_text(design, limits, header), "flips")
    done = run("./flips", given.sample, int(given.list))
    print(done.stdout, end="")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
