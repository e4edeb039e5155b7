#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""u of the compiled header in double, beside the optimum that DAQP finds over all inputs of the horizon.

    answers.py <build> DESIGN.toml NUMBER [--spoiled] [--float]

Plant and cost are those of the JSON file, limits those of the design file; the law, X, F and G are not read. Random
states, from a quarter to 16 times as far as the limits. --spoiled takes the seventh decimals out of F. --float
says how far u of the header in float is off, from the optimum with the prices that floats can tell; there is no bound.
Everything is written below the current folder. CC is the compiler.

Exit status 0: u is the optimum to 1e-9 of its range; 1: it is not; 2: something is not there.
"""

import argparse
import re
import sys
from pathlib import Path

import numpy as np
from mpmath import mp, mpf
from foresight import prepare, run, soft_states
from optimum import Problem, eye, solved

TOLERANCE = 1e-9  # of the range
FAR = 1e-3  # likewise
LEAST_ACTIVE = 0.25  # share of the states
PRICE = 1e6  # where the design file has none


mp.dps = 40


def exact(rows):
    """Numbers or rows of them, with as many digits as above."""
    return np.vectorize(mpf, otypes=[object])(np.array(rows, dtype=float))


def equilibrium(A, B, C):
    """Nx and Nu of x = A x + B u, C x = r."""
    nx, nu, nr = len(A), B.shape[1], len(C)
    assert nu == nr, "expected as many references as inputs"
    whole = np.block([[A - eye(nx, A), B], [C, exact(np.zeros((nr, nu)))]])
    N = solved(whole, exact(np.vstack([np.zeros((nx, nr)), np.eye(nr)])))
    return N[:nx], N[nx:]


def blocks_of(limits) -> list:
    """Single steps beside limits of changes or states, else longer ones (lqgen's manual)."""
    if "blocks" in limits:
        return limits["blocks"]
    if "u_rate" in limits or "states" in limits:
        return [1] * limits["horizon"]
    blocks, growing = [], [1, 1, 2, 4, 4]
    while sum(blocks) < limits["horizon"]:
        wanted = growing[len(blocks)] if len(blocks) < len(growing) else 8
        blocks.append(min(wanted, limits["horizon"] - sum(blocks)))
    return blocks


def case_of(design, limits) -> dict:
    known = {"horizon", "blocks", "u_min", "u_max", "u_rate", "states", "price"}
    assert set(limits) <= known, f"expected no other limits than {known}"
    plant, cost = design["plant"], design["cost"]
    case = {name: exact(plant[name]) for name in "AB"} | {name: exact(cost[name]) for name in "QRN"}
    case |= {"blocks": blocks_of(limits), "u_min": exact(limits["u_min"]), "u_max": exact(limits["u_max"])}
    nx, nu, price = len(plant["A"]), len(plant["B"][0]), mpf(limits.get("price", PRICE))
    if "u_rate" in limits:
        case["u_step"] = exact(limits["u_rate"]) * mpf(plant["sample_time"])
        case["step_price"] = price
    unit = eye(nx, case["A"])
    case["quantities"] = [
        (unit[plant["states"].index(name)], exact(np.zeros(nu)), False, mpf(low), mpf(high), price)
        for name, (low, high) in soft_states(design, limits)
    ]
    if design["lqr"].get("references"):
        case["Nx"], case["Nu"] = equilibrium(
            case["A"], case["B"], exact([plant["C"][i] for i in design["lqr"]["references"]])
        )
    return case


def without_seventh_decimals(table) -> str:
    return re.sub(r"(\.\d{6})\d", r"\1", table[0])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("design", type=Path)
    parser.add_argument("number", type=int)
    parser.add_argument("--spoiled", action="store_true")
    parser.add_argument("--float", action="store_true")
    given = parser.parse_args()
    change = (r"_LIMITS_F\[\d+\] = \{[^}]*\}", without_seventh_decimals) if given.spoiled else ("", "")
    real = "float" if given.float else "double"
    design, limits = prepare(given.build.resolve(), given.design.resolve(), real, change)
    case = case_of(design, limits)
    if given.float:
        case["prices"] = [quantity.get("price") for quantity in design["limits"]["quantities"]]
    problem = Problem(case)
    ranges, off, active, most = case["u_max"] - case["u_min"], [], 0, 0
    for line in run("./foresight", "answers", given.number).stdout.splitlines():
        numbers = np.array([float(word) for word in line.split()])
        u, count = problem.optimum(exact(numbers[: problem.given]), mpf(1e-20))
        active, most = active + (count > 0), max(most, count)
        off.append(float(max(abs(a - b) / size for a, b, size in zip(u, numbers[problem.given :], ranges))))
    worst, states, far = max(off), len(off), sum(share > FAR for share in off)
    print(
        f"{states} states, {active} with an active limit, {most} at most: u is off by {worst:.2g} of its range at "
        f"most, by more than {FAR} in {far}"
    )
    is_good = given.float or worst <= TOLERANCE
    return int(states < given.number or active < LEAST_ACTIVE * states or not is_good)


if __name__ == "__main__":
    sys.exit(main())
