#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes problem.h, what compare.c has to know of a model: problem.py <lqgen> MODEL.toml <folder>

Everything is from the JSON files of two designs: the model as it is, and with single steps in place of blocks.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "flips"))
from closed_loop import array

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "foresight"))
from foresight import INFINITE, limits_of, start_factor


def design_of(lqgen: str, text: str, folder: Path):
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "design.toml"
    file.write_text(text)
    subprocess.run([lqgen, file, "-o", folder, "--only", "json", "--quiet"], check=True)
    return json.loads(next(folder.glob("*.json")).read_text())


def tables_of(design, name: str) -> str:
    """What lqg_mpc_control takes."""
    limits = design["limits"]
    quantities = limits["quantities"]
    bounds = [limits_of(quantity) for quantity in quantities]
    assert all(-INFINITE < low and high < INFINITE for low, high in bounds)
    scale = [limits["G"][i][i] ** -0.5 for i in range(len(bounds))]
    text = array(f"{name}_F", limits["F"]) + array(f"{name}_G", limits["G"]) + array(f"{name}_scale", [scale])
    text += array(f"{name}_low", [[low for low, _ in bounds]]) + array(f"{name}_high", [[high for _, high in bounds]])
    text += array(f"{name}_tolerance", [[1e-12 * (high - low) for low, high in bounds]])
    arguments = ", ".join(f"{name}_{table}" for table in ("F", "G", "scale", "low", "high", "tolerance"))
    return text + f"static const lqg_mpc_t {name} = {{NX, NU, {len(bounds)}, 100000, K, {arguments}, NULL}};\n"


def inputs_ahead(design) -> list:
    """The rows of single steps that are inputs, sample by sample."""
    inputs = [name.split(" [")[0] for name in design["plant"]["inputs"]]
    return [i for i, quantity in enumerate(design["limits"]["quantities"]) if quantity["name"] in inputs]


def limited_states(design) -> list:
    """(state, low, high, price), as single steps have them one sample ahead."""
    names = [name.split(" [")[0] for name in design["plant"]["states"]]
    return [
        (names.index(quantity["name"]), *limits_of(quantity), quantity["price"])
        for quantity in design["limits"]["quantities"]
        if quantity["sample"] == 1 and "price" in quantity
    ]


def main() -> None:
    lqgen, model, folder = sys.argv[1], Path(sys.argv[2]).read_text(), Path(sys.argv[3])
    horizon = int(re.search(r"^horizon *= *(\d+)", model, re.M).group(1))
    steps = f"blocks = [{', '.join(['1'] * horizon)}]"
    blocks = design_of(lqgen, model, folder / "blocks")
    singles = design_of(lqgen, re.sub(r"^(horizon .*)", rf"\1\n{steps}", model, flags=re.M), folder / "singles")
    plant, states = singles["plant"], limited_states(singles)
    nx, nu = len(plant["A"]), len(plant["B"][0])
    text = f"enum {{ NX = {nx}, NU = {nu}, HORIZON = {horizon}, STATES = {len(states)} }};\n"
    text += array("A", plant["A"]) + array("B", plant["B"])
    text += "".join(array(name, singles["cost"][name]) for name in "QRN")
    text += array("X", singles["lqr"]["X"]) + array("K", singles["lqr"]["K"])
    text += array("start_factor", start_factor(singles))
    text += array("limited_state", [[state[0] for state in states]], "int").replace(".0", "")
    for place, name in enumerate(("x_low", "x_high", "price"), 1):
        text += array(name, [[state[place] for state in states]])
    text += array("input_row", [inputs_ahead(singles)], "int").replace(".0", "")
    text += tables_of(singles, "single_steps") + tables_of(blocks, "in_blocks")
    text += f"enum {{ HAS_BLOCKS = {int(blocks['limits']['G'] != singles['limits']['G'])} }};\n"
    (folder / "problem.h").write_text(text)


if __name__ == "__main__":
    main()
