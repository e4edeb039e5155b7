# SPDX-License-Identifier: MIT
"""A design file from a plant and from weights, wherever they come from."""

from pathlib import Path

from . import toml
from .errors import DesignError, expected
from .names import design_name
from .plant import plant_table, two_dimensional
from .words import unknown

SECTIONS = (
    "parameters",
    *("lqr", "pole_placement", "kalman", "observer", "compensator", "uncertain"),
    *("limits", "stage", "require", "code", "scenario"),
)
SEVERAL = ("uncertain", "stage", "scenario")  # tables of this name


def design_text(
    plant,
    *,
    name,
    brief=None,
    sample_time=None,
    domain=None,
    G=None,
    H=None,
    delay=None,
    states=None,
    inputs=None,
    outputs=None,
    Q=None,
    R=None,
    N=None,
    W=None,
    V=None,
    Swv=None,
    **sections,
):
    """The text of the design file `name` for `plant`, which is one of

    - a StateSpace of python-control. A continuous one (dt = 0) needs `sample_time`; labels become the names of states,
      inputs and outputs, as `dy1 [m]`;
    - a TransferFunction of python-control, which becomes a minimal state space: `transfer.py` says with which states;
    - an lti or dlti of scipy.signal, transfer functions likewise;
    - matrices (A, B), (A, B, C), (A, B, C, D) with `domain` "continuous" or "discrete", or (A, B, C, D, dt);
    - a dictionary with the keys of [plant].

    `sample_time` … `outputs` are keys of [plant]; Q, R and N those of [lqr]; W, V and Swv are process_noise,
    measurement_noise and cross_noise of [kalman]. Every other key is given in its section, as
    `kalman={"gain": "online"}` or `stage=[{"from": 20, "R": [2]}]`. A number in place of a matrix is one of 1 × 1. A
    text in place of a number is an expression over `parameters`: `parameters={"m": 2}, B=[[0], ["1/m"]]`.
    lqgen checks the whole.
    """
    for word in sections:
        if word not in SECTIONS:
            raise unknown(word)
    sections = {section: table_of(section, value) for section, value in sections.items() if value is not None}
    given = {
        "domain": domain,
        "sample_time": sample_time,
        "G": two_dimensional(G),
        "H": two_dimensional(H),
        "delay": delay,
        "states": states,
        "inputs": inputs,
        "outputs": outputs,
    }
    tables = {"parameters": sections.get("parameters"), "plant": plant_table(plant, given)}
    tables["lqr"] = merged("lqr", sections, {"Q": Q, "R": R, "N": N})
    tables["kalman"] = merged("kalman", sections, {"process_noise": W, "measurement_noise": V, "cross_noise": Swv})
    for section in SECTIONS:
        tables.setdefault(section, sections.get(section))
    top = {"name": design_name(name), "brief": brief}
    return toml.document(top, {key: table for key, table in tables.items() if table})


def table_of(section, value):
    """A section as a table; `uncertain`, `stage` and `scenario` are several."""
    if section in ("uncertain", "scenario") and isinstance(value, dict):
        return [value]
    if section in SEVERAL:
        if not isinstance(value, (list, tuple)) or not all(isinstance(item, dict) for item in value):
            raise expected(section, "a list of dictionaries", f"{type(value).__name__} {value!r}")
    elif not isinstance(value, dict):
        raise expected(section, "a dictionary", f"{type(value).__name__} {value!r}")
    return value


def merged(section, sections, given):
    """The section with what was given by letter."""
    table = dict(sections.get(section) or {})
    for key, value in given.items():
        if value is None:
            continue
        if table.get(key) is not None:
            raise DesignError(f"{section}.{key}: given twice")
        table[key] = two_dimensional(value)
    return table


def write_design(path, plant, **keys):
    """Writes `design_text(plant, **keys)` to the file `path`; `name` is that of the file unless it is given."""
    keys.setdefault("name", Path(path).stem)
    text = design_text(plant, **keys)
    Path(path).write_text(text, encoding="utf-8")
