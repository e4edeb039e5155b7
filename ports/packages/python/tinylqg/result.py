# SPDX-License-Identifier: MIT
"""NAME.json, read back into Python and from there into other tools."""

import json
from pathlib import Path

from . import loop
from .errors import DesignError, expected, needs, refusing
from .names import design_name

SHORT = {"K": "lqr", "L": "kalman"}
NAMES = ("states", "inputs", "outputs")


class Table(dict):
    """A table of NAME.json; design.lqr.K is design["lqr"]["K"]. What a design does not have is not there."""

    def __getattr__(self, key):
        try:
            return self[key]
        except KeyError:
            raise AttributeError(f"this design has no {key}; it has {', '.join(self)}") from None


class Result(Table):
    """A design as lqgen solved it, with the keys of NAME.json. Matrices are arrays of NumPy where it is installed, else
    lists of rows; poles are complex. `plant` is the sampled one. K is lqr.K: u = −K x̂, and L is kalman.L:
    x̂ ← x̂ + L (y − C x̂ − D u)."""

    def __getattr__(self, key):
        if key in SHORT:
            return getattr(super().__getattr__(SHORT[key]), key)
        return super().__getattr__(key)

    def state_space(self, part="plant", references=False):
        """(A, B, C, D) of a part, and the names of its states, inputs and outputs.

        "plant": x⁺ = A x + B u, y = C x + D u; without outputs y = x. "controller": from y to u, what the firmware
        computes while no limit acts, with r = 0 or, with `references`, with r as further inputs. "sensed": from u to y,
        the plant as the controller sees it; with the controller it closes the loop that has design.loop.poles. It is
        the plant, but without a filter y is the state, and in the filter form y is taken while the last u acts: where D
        ≠ 0, that u is a state. With stages, controller and plant are the last ones here. All of them are of deviations
        from `plant.operating_point`, where the design has one.
        """
        if part == "plant":
            return loop.plant(self)
        if part == "sensed":
            return loop.sensed(self)
        if part == "controller":
            return loop.controller(self, references)
        raise expected("part", '"plant", "sensed" or "controller"', repr(part))

    def to_control(self, part="plant", references=False):
        """A discrete StateSpace of python-control; `part` and `references` as in `state_space`."""
        try:
            import control
        except ImportError:
            raise needs("python-control", "to_control()", "control") from None
        matrices, names = self.state_space(part, references)
        return control.ss(*matrices, self.plant.sample_time, name=f"{self.name}_{part}", **names)

    def to_scipy(self, part="plant", references=False):
        """A discrete StateSpace of scipy.signal; `part` and `references` as in `state_space`."""
        try:
            from scipy.signal import StateSpace
        except ImportError:
            raise needs("scipy", "to_scipy()", "mat") from None
        matrices, _ = self.state_space(part, references)
        return StateSpace(*matrices, dt=self.plant.sample_time)

    def save_mat(self, path):
        """A .mat file (version 5) that MATLAB, Octave and Scilab load: A, B, C, D, G, Ts of the sampled plant, its
        names, and all of noise, cost, lqr and kalman under the names of NAME.json."""
        try:
            from scipy.io import savemat
        except ImportError:
            raise needs("scipy", "save_mat()", "mat") from None
        with refusing(self.name, "a design as lqgen writes it"):
            savemat(path, mat_variables(self), oned_as="column", appendmat=False)


def mat_variables(design):
    """One variable for each; a schedule is nu × nx × steps, poles of other things than the loop keep their owner's
    name."""
    import numpy

    values = {"name": design.name, "Ts": design.plant.sample_time}
    values.update({key: design.plant[key] for key in "ABCDG"})
    for key in NAMES:
        values[key] = numpy.array(design.plant[key], dtype=object).reshape(-1, 1)
    for owner in ("noise", "cost", "lqr", "kalman"):
        for key, value in design.get(owner, {}).items():
            if key in ("poles", "schedule"):
                values[f"{owner}_{key}"] = numpy.moveaxis(value, 0, -1) if key == "schedule" else value
            elif isinstance(value, numpy.ndarray):
                values["Swv" if key == "cross" else key] = value
    values["poles"] = design.loop.poles
    return values


def load(path):
    """The design in the file NAME.json that lqgen wrote, as a `Result`."""
    return result_of(path, Path(path).read_bytes())


def result_of(path, data):
    """The same of the file's bytes; messages call it `path`."""
    with refusing(path, "the JSON file of a design"):
        tables = json.loads(data.decode("utf-8"))
        if not isinstance(tables, dict) or not {"lqgen", "name", "plant"} <= tables.keys():
            raise DesignError(f"{path}: expected a JSON file that lqgen wrote")
        design_name(tables["name"], f"{path}: name")
        check_tables(path, tables)
        design = Result(converted(tables))
        for plant in (design.plant, *(stage.plant for stage in design.get("stages", []))):
            fix_empty(plant)
        return design


def check_tables(path, tables):
    """What is a table is one, and plants have matrices that fit each other."""
    for key in ("plant", "noise", "cost", "lqr", "kalman", "loop"):
        if not isinstance(tables.get(key, {}), dict):
            raise expected(path, f"a table {key}", type(tables[key]).__name__)
    stages = tables.get("stages", [])
    if not isinstance(stages, list) or not all(isinstance(stage, dict) for stage in stages):
        raise expected(path, "a list of tables stages", type(stages).__name__)
    first = tables["plant"]
    for key in NAMES:
        if not is_list_of(first.get(key), str):
            raise expected(path, f"names in plant.{key}", type(first.get(key)).__name__)
    for plant in (first, *(stage.get("plant") for stage in stages)):
        check_plant(path, plant)


def check_plant(path, plant):
    """A is nx × nx, B nx × nu, C ny × nx, D ny × nu; without outputs the last two have no rows."""
    if not isinstance(plant, dict):
        raise expected(path, "a table plant", type(plant).__name__)
    for key in "ABCD":
        if not is_list_of(plant.get(key), list):
            raise expected(path, f"rows of numbers in plant.{key}", type(plant.get(key)).__name__)
    nx, ny, nu = len(plant["A"]), len(plant["C"]), len(plant["B"][0]) if plant["B"] else 0
    if nx == 0:
        raise expected(path, "states", "a plant without any")
    for key, rows, columns in (("A", nx, nx), ("B", nx, nu), ("C", ny, nx), ("D", ny, nu)):
        matrix = plant[key]
        if len(matrix) != rows or not all(len(row) == columns and is_list_of(row, (int, float)) for row in matrix):
            raise expected(path, f"{rows} rows of {columns} numbers in plant.{key}", "others")


def is_list_of(value, kind):
    return isinstance(value, list) and all(isinstance(item, kind) for item in value)


def converted(value, key=None):
    """Tables with attributes; lists of numbers, of rows and of matrices as arrays."""
    if isinstance(value, dict):
        return Table({name: converted(item, name) for name, item in value.items()})
    if not isinstance(value, list) or key in NAMES:
        return value
    if key in ("poles", "full_poles"):
        return array([complex(real, imaginary) for real, imaginary in value])
    if any(isinstance(item, dict) for item in value):
        return [converted(item) for item in value]
    return array(value)


def array(value):
    try:
        import numpy
    except ImportError:
        return value
    return numpy.array(value)


def fix_empty(table):
    """A matrix without rows does not say how many columns it has."""
    if not hasattr(table.A, "shape"):
        return
    nx = len(table.A)
    nu = table.B.shape[1]
    table["C"] = table.C.reshape(-1, nx)
    table["D"] = table.D.reshape(len(table.C), nu)
