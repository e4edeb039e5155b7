"""MATLAB's .mat files, which Octave and Scilab read and write, too."""

from pathlib import Path

from .design import SECTIONS
from .errors import DesignError, expected, needs
from .plant import timed

MATRICES = ("A", "B", "C", "D", "G", "H", "N", "cross_noise", "structure")
NUMBERS = ("sample_time", "Ts", "delay", "decay", "settling_time", "horizon", "gate", "rho", "from", "gain_margin_dB",
           "phase_margin_deg", "disk_margin", "max_pole", "flash")

# Which section a variable belongs to, and how it is called there.
HOMES = {
    **{key: ("plant", key) for key in ("A", "B", "C", "D", "G", "H", "delay", "states", "inputs", "outputs",
                                       "sample_time", "domain")},
    **{key: ("lqr", key) for key in ("Q", "R", "N")},
    "W": ("kalman", "process_noise"),
    "V": ("kalman", "measurement_noise"),
    "Swv": ("kalman", "cross_noise"),
    "x0": ("kalman", "initial_state"),
    "P0": ("kalman", "initial_covariance"),
    **{key: ("limits", key) for key in ("u_min", "u_max", "u_rate")},
}
V73_HEADER = b"MATLAB 7.3"


def read_mat(path, variable=None):
    """What `design_text` and `write_design` take, from a .mat file: `write_design("motor.toml", **read_mat("motor.mat"))`.

    Its variables are A, B, C, D, G, H, Q, R, N, W, V, Swv, x0, P0, u_min, u_max, u_rate, delay, states, inputs, outputs,
    name, brief, and Ts as MATLAB means it: 0, or none, is a continuous plant, which needs sample_time as well. A
    structure with the name of a section (lqr, kalman, …) has that section's keys. With `variable` they are the fields
    of that structure, or the variable is a system that Octave's `ss` made. A variable that is none of these is an error.
    """
    variables = load_v73(path) if is_v73(path) else load_v5(path)
    if variable is None and len(variables) == 1 and is_system(*variables.values()):
        (variable,) = variables
    if variable is not None:
        if not isinstance(variables.get(variable), dict):
            raise expected(path, f"a structure {variable}", "the variables " + ", ".join(variables))
        variables = variables[variable]
    return arguments(path, variables)


def is_v73(path):
    with Path(path).open("rb") as file:
        return file.read(len(V73_HEADER)) == V73_HEADER


def load_v5(path):
    """Versions 4 to 7, by scipy; a structure as a dictionary."""
    try:
        from scipy.io import loadmat
    except ImportError:
        raise needs("scipy", "reading a .mat file", "mat") from None
    try:
        found = loadmat(path)
    except OSError:
        raise
    except Exception as problem:  # whatever a file that is none makes scipy stumble over
        raise expected(path, "a .mat file", f"one that scipy cannot read ({problem})") from None
    return {name: of_v5(path, name, value) for name, value in found.items()
            if not name.startswith("__") and name != "None"}


def is_system(value):
    return isinstance(value, dict) and "A" in value


def of_v5(path, name, value):
    if getattr(value, "classname", None) == "ss":
        return of_octave_system(path, name, value.flat[0])
    if type(value).__name__ in ("MatlabOpaque", "MatlabFunction", "MatlabObject"):
        raise expected(path, "matrices", f"the object {name}; [A, B, C, D] = ssdata(sys); Ts = sys.Ts; makes them")
    if value.dtype.names is not None:
        items = [{key: of_v5(path, f"{name}.{key}", item[key]) for key in value.dtype.names} for item in value.flat]
        return items[0] if len(items) == 1 else items
    if value.dtype == object:
        return [of_v5(path, name, item) for item in value.flat]
    if value.dtype.kind in "US":
        texts = [str(text) for text in value.flat]
        return "".join(texts) if len(texts) < 2 else texts
    return value.toarray() if hasattr(value, "toarray") else value


def of_octave_system(path, name, system):
    """What `ss` of Octave's control package keeps; names only where each has one."""
    if system["e"].size > 0:
        raise expected(path, "a system with ẋ or x⁺ alone on its left side", f"the descriptor system {name}")
    time_base = system["lti"].flat[0]
    table = {key: system[key.lower()] for key in "ABCD"}
    table["Ts"] = time_base["tsam"]
    for key, labels in (("states", system["stname"]), ("inputs", time_base["inname"]), ("outputs", time_base["outname"])):
        names = of_v5(path, name, labels)
        if names and all(names):
            table[key] = names
    return table


def load_v73(path):
    """Version 7.3 is HDF5: every array transposed, text as numbers, cells as references."""
    try:
        import h5py
    except ImportError:
        raise needs("h5py", "reading a .mat file of version 7.3 (or save it with -v7)", "mat73") from None
    with h5py.File(path, "r") as file:
        return {name: of_v73(file, path, item) for name, item in file.items() if not name.startswith("#")}


def of_v73(file, path, item):
    import h5py

    if isinstance(item, h5py.Group):
        return {key: of_v73(file, path, value) for key, value in item.items()}
    kind = item.attrs.get("MATLAB_class", b"").decode()
    value = item[()].T
    if kind == "cell":
        return [of_v73(file, path, file[reference]) for reference in value.flat]
    if kind == "char":
        return "" if "MATLAB_empty" in item.attrs else "".join(chr(code) for code in value.flat)
    if value.dtype.names == ("real", "imag"):
        return value["real"] + 1j * value["imag"]
    if value.dtype.kind not in "fiub" or "MATLAB_object_decode" in item.attrs:
        raise expected(path, "matrices", f"{item.name[1:]} of the class {kind or value.dtype}")
    return value


def arguments(path, variables):
    """The variables as keyword arguments of `design_text`; an empty matrix is none."""
    variables = {name: value for name, value in variables.items() if getattr(value, "size", 1) > 0}
    tables, top, unknown = {}, {}, []
    for name, value in variables.items():
        if name in SECTIONS:
            tables[name] = section(name, value)
        elif name in HOMES:
            home, key = HOMES[name]
            tables.setdefault(home, {})[key] = shaped(key, value)
        elif name in ("name", "brief"):
            top[name] = value
        elif name != "Ts":
            unknown.append(name)
    if unknown:
        raise expected(path, "the variables " + ", ".join([*HOMES, "Ts", "name", "brief", *SECTIONS]),
                       ", ".join(unknown))
    for name, value in variables.items():  # a variable beside the structure that has its section
        home, key = HOMES.get(name, (None, None))
        if home in SECTIONS:
            tables[home] = {**tables[home], key: shaped(key, value)}
    if "A" not in tables.get("plant", {}):
        raise expected(path, "the matrix A", "the variables " + (", ".join(variables) or "of an empty file"))
    tables["plant"] = with_time(path, tables["plant"], variables.get("Ts"))
    return {**top, **tables}


def with_time(path, plant, Ts):
    """Ts = 0 says that the plant is continuous, as no Ts does; MATLAB's −1 is a sample time that is not known."""
    if Ts is None:
        return plant
    period = shaped("Ts", Ts)
    if period < 0:
        raise expected(path, "Ts = 0 (continuous) or the sample time in s", period)
    timed_plant = timed({}, period)
    for key, value in timed_plant.items():
        if plant.get(key, value) != value:
            raise DesignError(f"{path}: Ts = {period:g} says {key} = {value!r}, there is {plant[key]!r}, too")
    return {**plant, **timed_plant}


def section(name, value):
    """A structure as that section; `stage` may be several, and is always a list of tables."""
    structures = value if isinstance(value, list) else [value]
    if not all(isinstance(item, dict) for item in structures) or (len(structures) != 1 and name != "stage"):
        raise expected(name, "a structure", "something else")
    tables = [{key: section(key, item) if isinstance(item, dict) else shaped(key, item) for key, item in structure.items()}
              for structure in structures]
    return tables if name == "stage" else tables[0]


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
