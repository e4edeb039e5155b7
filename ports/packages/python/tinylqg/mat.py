# SPDX-License-Identifier: MIT
"""The variables of a .mat file as keys of a design file."""

from .design_file import SECTIONS, SEVERAL
from .errors import DesignError, expected
from .mat_file import variables_of
from .plant import scalar, timed

MATRICES = ("A", "B", "C", "D", "G", "H", "N", "cross_noise", "structure")
NUMBERS = (
    "sample_time",
    "Ts",
    "delay",
    "decay",
    "settling_time",
    "horizon",
    "gate",
    "rho",
    "from",
    "gain_margin_dB",
    "phase_margin_deg",
    "disk_margin",
    "max_pole",
    "flash",
)

# Which section a variable belongs to, and how it is called there.
HOMES = {
    **{
        key: ("plant", key)
        for key in ("A", "B", "C", "D", "G", "H", "delay", "states", "inputs", "outputs", "sample_time", "domain")
    },
    **{key: ("lqr", key) for key in ("Q", "R", "N")},
    "W": ("kalman", "process_noise"),
    "V": ("kalman", "measurement_noise"),
    "Swv": ("kalman", "cross_noise"),
    "x0": ("kalman", "initial_state"),
    "P0": ("kalman", "initial_covariance"),
    **{key: ("limits", key) for key in ("u_min", "u_max", "u_rate")},
}
TOP = ("name", "brief")


def read_mat(path, variable=None):
    """What `design_text` and `write_design` take, from a .mat file: `write_design("motor.toml",
    **read_mat("motor.mat"))`.

    Its variables are A, B, C, D, G, H, Q, R, N, W, V, Swv, x0, P0, u_min, u_max, u_rate, delay, states, inputs,
    outputs, name, brief, and Ts as MATLAB means it: 0, or none, is a continuous plant, which needs sample_time as well.
    A structure with the name of a section (lqr, kalman, …) has that section's keys. With `variable` they are the fields
    of that structure, or the variable is a system that Octave's `ss` made. A variable that is none of these is an
    error.
    """
    variables = variables_of(path)
    if variable is None and len(variables) == 1 and is_system(*variables.values()):
        (variable,) = variables
    if variable is not None:
        if not isinstance(variables.get(variable), dict):
            raise expected(path, f"a structure {variable}", "the variables " + ", ".join(variables))
        variables = variables[variable]
    return arguments(path, variables)


def is_system(value):
    return isinstance(value, dict) and "A" in value


def arguments(path, variables):
    """The variables as keyword arguments of `design_text`; an empty matrix is none."""
    variables = {name: value for name, value in variables.items() if not is_empty(value)}
    unknown = [name for name in variables if name not in (*HOMES, *TOP, *SECTIONS, "Ts")]
    if unknown:
        raise expected(path, "the variables " + ", ".join((*HOMES, "Ts", *TOP, *SECTIONS)), ", ".join(unknown))
    top = {name: value for name, value in variables.items() if name in TOP}
    tables = {name: section(name, value) for name, value in variables.items() if name in SECTIONS}
    for name, value in variables.items():
        if name not in HOMES:
            continue
        home, key = HOMES[name]
        table = tables.setdefault(home, {})
        if key in table:
            raise DesignError(f"{path}: {home}.{key}: given twice, as {name} and in the structure {home}")
        table[key] = shaped(key, value)
    if "A" not in tables.get("plant", {}):
        raise expected(path, "the matrix A", "the variables " + (", ".join(variables) or "of an empty file"))
    tables["plant"] = with_time(path, tables["plant"], variables.get("Ts"))
    return {**top, **tables}


def is_empty(value):
    return getattr(value, "size", 1) == 0 or (isinstance(value, list) and len(value) == 0)


def with_time(path, plant, Ts):
    """Ts = 0 says that the plant is continuous, as no Ts does; MATLAB's −1 is a sample time that is not known."""
    if Ts is None:
        return plant
    period = scalar("sample_time", shaped("Ts", Ts))
    if isinstance(period, str) or period < 0:
        raise expected(path, "Ts = 0 (continuous) or the sample time in s", period)
    timed_plant = timed({}, period)
    for key, value in timed_plant.items():
        if key in plant and scalar(key, plant[key]) != value:
            raise DesignError(f"{path}: Ts = {period:g} says {key} = {value!r}, there is {plant[key]!r}, too")
    return {**plant, **timed_plant}


def section(name, value):
    """A structure as that section; `stage` and `scenario` may be several, and are always a list of tables."""
    structures = value if isinstance(value, list) else [value]
    if not all(isinstance(item, dict) for item in structures) or (len(structures) != 1 and name not in SEVERAL):
        raise expected(name, "a structure", "something else")
    tables = [
        {key: section(key, item) if isinstance(item, dict) else shaped(key, item) for key, item in structure.items()}
        for structure in structures
    ]
    return tables if name in SEVERAL else tables[0]


def shaped(key, value):
    """MATLAB has nothing but matrices: those of the design file stay what they are, vectors become lists."""
    if isinstance(value, (str, list)) or not hasattr(value, "ndim"):
        return value
    if key in NUMBERS:
        if value.size != 1:
            raise expected(key, "a number", f"{' × '.join(map(str, value.shape))} numbers")
        return value.flat[0].item()
    if key in MATRICES or min(value.shape) > 1:
        return value
    return value.reshape(-1)
