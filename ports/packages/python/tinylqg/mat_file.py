"""MATLAB's .mat files, which Octave and Scilab write, too: matrices, texts, cells as lists, structures as dictionaries."""

from pathlib import Path

from .errors import expected, needs

V73_HEADER = b"MATLAB 7.3"


def variables_of(path):
    """By name."""
    return load_v73(path) if is_v73(path) else load_v5(path)


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

    kind = item.attrs.get("MATLAB_class", b"").decode()
    if isinstance(item, h5py.Group):
        fields = {key: of_v73(file, path, value) for key, value in item.items()}
        return one_by_one(fields) if all(is_field_of_many(value) for value in item.values()) else fields
    if "MATLAB_empty" in item.attrs:
        return "" if kind == "char" else [] if kind == "cell" else item[:0]
    value = item[()].T
    if value.dtype == object:
        return [of_v73(file, path, file[reference]) for reference in value.flat]
    if kind == "char":
        return "".join(chr(code) for code in value.flat)
    if value.dtype.names == ("real", "imag"):
        return value["real"] + 1j * value["imag"]
    if value.dtype.kind not in "fiub" or "MATLAB_object_decode" in item.attrs:
        raise expected(path, "matrices", f"{item.name[1:]} of the class {kind or value.dtype}")
    return value


def is_field_of_many(item):
    """References to the values of a field in an array of structures; those of a cell have a class."""
    return getattr(item, "dtype", None) == object and "MATLAB_class" not in item.attrs


def one_by_one(fields):
    """An array of structures, which HDF5 has field by field."""
    return [dict(zip(fields, values)) for values in zip(*fields.values())]
