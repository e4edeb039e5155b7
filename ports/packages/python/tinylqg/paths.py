# SPDX-License-Identifier: MIT
"""Places in a design file: "lqr.Q[1]", "plant.delay", "scenario[0].plant.scale[0].factor", or a short name."""

import copy
import difflib
import json
import re
from functools import lru_cache

from .errors import DesignError, expected
from .toml import plain

STEP = re.compile(r"(\w+)((?:\[\d+\])*)")

TOP = ("name", "brief")
LETTERS = {
    **{key: f"plant.{key}" for key in ("A", "B", "C", "D", "G", "H")},
    **{key: f"lqr.{key}" for key in ("Q", "R", "N")},
    "W": "kalman.process_noise",
    "V": "kalman.measurement_noise",
    "Swv": "kalman.cross_noise",
    "horizon": "lqr.horizon",
    "structure": "lqr.structure",
    "poles": "pole_placement.poles",
    "states": "plant.states",
    "outputs": "plant.outputs",
    "inputs": "plant.inputs",
}


def with_values(tables, values):
    """A copy of a design file's tables with other values, by their places."""
    tables = copy.deepcopy(tables)
    for path, value in values.items():
        if path == "rho":
            set_rho(tables, value)
        else:
            set_value(tables, path, plain(value, path))
    return tables


def set_rho(tables, rho):
    """The factor of the inputs' weight: that of Bryson's rule, or of R."""
    law = tables.get("lqr", {})
    rho = plain(rho, "rho")
    if "bryson" in law:
        law["bryson"]["rho"] = rho
    elif "R" in law:
        law["R"] = scaled(law["R"], rho)
    else:
        raise DesignError("rho: expected a design with R or bryson in [lqr]")


def scaled(value, factor):
    if isinstance(value, str):
        return f"({value})*{factor!r}"
    return [scaled(item, factor) for item in value] if isinstance(value, list) else value * factor


def set_value(tables, path, value):
    steps = steps_of(path)
    place = tables
    for step, following in zip(steps, steps[1:]):
        if isinstance(place, dict) and step not in place:
            if isinstance(following, int):
                raise DesignError(f"{path}: the design has no {step} to change an entry of")
            place[step] = {}
        place = entry(place, step, path)
    if isinstance(place, list):
        entry(place, steps[-1], path)
    elif not isinstance(place, dict):
        raise expected(path, "a place in a table or a list", "one in a number or a text")
    elif steps[0] == "parameters" and isinstance(place.get(steps[-1]), dict) and not isinstance(value, dict):
        place, steps = place[steps[-1]], [*steps, "value"]  # the unit stays
    place[steps[-1]] = value


def entry(place, step, path):
    if isinstance(place, dict) and isinstance(step, str):
        return place[step]
    if not isinstance(place, list) or not isinstance(step, int):
        raise expected(path, "names of tables and numbers of lists", repr(step))
    if step >= len(place):
        raise expected(path, f"a number below {len(place)}", step)
    return place[step]


def steps_of(path):
    """ "lqr.Q[1]" as ["lqr", "Q", 1], with a short name's whole path."""
    parts = [STEP.fullmatch(part) for part in path.split(".")]
    if not all(parts):
        raise expected(path, 'a place such as "lqr.Q[1]"', repr(path))
    first = parts[0][1]
    if first not in sections() and first not in TOP:
        if len(parts) > 1:
            raise unknown(path, first, sections())
        return [*whole(first).split("."), *numbers(parts[0][2])]
    steps = []
    for part in parts:
        steps += [part[1], *numbers(part[2])]
    if isinstance(steps[-1], str) and len(steps) > 1:
        check_key(path, steps)
    return steps


def numbers(text):
    return [int(number) for number in re.findall(r"\d+", text)]


def whole(name):
    """The path of a short name."""
    if name in LETTERS:
        return LETTERS[name]
    homes = [f"{section}.{name}" for section, keys in sections().items() if name in keys]
    if len(homes) == 1:
        return homes[0]
    if homes:
        raise expected(name, " or ".join(homes), "a name that several sections have")
    keys = {key for keys in sections().values() for key in keys}
    raise unknown(name, name, {*keys, *LETTERS, "rho"})


def check_key(path, steps):
    """That a key right below a section is one."""
    keys = sections().get(steps[0], ())
    if len(steps) == 2 and keys and steps[1] not in keys:
        raise unknown(path, steps[1], keys)


def unknown(path, word, known):
    near = difflib.get_close_matches(word, known, 1)
    return DesignError(f"{path}: unknown" + (f", did you mean {near[0]}?" if near else f"; {word} is no key"))


@lru_cache(maxsize=1)
def sections():
    """The keys of each section, as lqgen knows them."""
    from .lqgen import run_lqgen

    tables = json.loads(run_lqgen("--schema")[0])["properties"]
    keys = {name: table.get("properties") or table.get("items", {}).get("properties") for name, table in tables.items()}
    return {name: tuple(keys[name] or ()) for name, table in tables.items() if keys[name] or is_open(table)}


def is_open(table):
    """[parameters], whose keys are anybody's."""
    return "additionalProperties" in table and table["additionalProperties"] is not False
