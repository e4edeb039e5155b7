# SPDX-License-Identifier: MIT
"""MATLAB's .mat files, which Octave and Scilab write, too: matrices, texts, cells as lists, structures as dictionaries.

A file may be hostile: it is refused before it has taken much memory or stack, and never leads to another file."""

import io
import math
import zlib
from pathlib import Path

from . import apart
from .errors import expected, needs, refusing

LARGEST_FILE = 2**26  # bytes, unpacked
MOST_ARRAYS = 1000  # scipy reads one in another by recursion that Python does not watch
MOST_NUMBERS = 10**6
LARGEST_ENTRY = 16  # bytes: a complex number
DEEPEST = 8  # structures and cells in each other
V73_HEADER = b"MATLAB 7.3"


def variables_of(path):
    """By name."""
    with Path(path).open("rb") as file:
        data = file.read(LARGEST_FILE + 1)
    if len(data) > LARGEST_FILE:
        raise expected(path, "a .mat file", f"more than {LARGEST_FILE} bytes")
    return apart.variables(path, data)


def variables_in(path, data):
    """Those of the file `path`, which has these bytes."""
    with refusing(path, "a .mat file"):
        return load_v73(path, data) if data.startswith(V73_HEADER) else load_v5(path, data)


def load_v5(path, data):
    """Versions 4 to 7, by scipy; a structure as a dictionary."""
    try:
        from scipy.io import loadmat
    except ImportError:
        raise needs("scipy", "reading a .mat file", "mat") from None
    arrays = sum(part.count(mark) for part in (data, *unpacked(path, data)) for mark in (b"\x0e\0\0\0", b"\0\0\0\x0e"))
    if arrays > MOST_ARRAYS:
        raise expected(path, f"a .mat file of at most {MOST_ARRAYS} arrays", "more")
    found = loadmat(io.BytesIO(data))
    return {
        name: of_v5(path, name, value) for name, value in found.items() if not name.startswith("__") and name != "None"
    }


def unpacked(path, data):
    """The compressed elements of version 7, which stand one behind the other after a header of 128 bytes."""
    order = "little" if data[126:128] == b"IM" else "big"
    at, left = 128, LARGEST_FILE
    while at + 8 <= len(data):
        kind, size = (int.from_bytes(data[at + i : at + i + 4], order) for i in (0, 4))
        if kind == 15:
            unpacker = zlib.decompressobj()
            part = unpacker.decompress(data[at + 8 : at + 8 + size], left + 1)
            left -= len(part)
            if left < 0:
                raise expected(path, "a .mat file", f"more than {LARGEST_FILE} bytes, unpacked")
            yield part
        at += 8 + size


def of_v5(path, name, value, depth=0):
    check_depth(path, depth)
    if getattr(value, "classname", None) == "ss":
        return of_octave_system(path, name, value.flat[0])
    if type(value).__name__ in ("MatlabOpaque", "MatlabFunction", "MatlabObject"):
        raise expected(path, "matrices", f"the object {name}; [A, B, C, D] = ssdata(sys); Ts = sys.Ts; makes them")
    check_size(path, name, value.shape)
    if value.dtype.names is not None:
        items = [
            {key: of_v5(path, f"{name}.{key}", item[key], depth + 1) for key in value.dtype.names}
            for item in value.flat
        ]
        return items[0] if len(items) == 1 else items
    if value.dtype == object:
        return [of_v5(path, name, item, depth + 1) for item in value.flat]
    if value.dtype.kind in "US":
        texts = [str(text) for text in value.flat]
        return "".join(texts) if len(texts) < 2 else texts
    if hasattr(value, "toarray"):
        value.check_format(full_check=True)
        return value.toarray()
    return value


def check_depth(path, depth):
    if depth > DEEPEST:
        raise expected(path, f"structures and cells at most {DEEPEST} in each other", "more")


def check_size(path, name, shape):
    if math.prod(shape) > MOST_NUMBERS:
        raise expected(path, f"at most {MOST_NUMBERS} numbers in an array", f"{name} of {' × '.join(map(str, shape))}")


def of_octave_system(path, name, system):
    """What `ss` of Octave's control package keeps; names only where each has one."""
    if system["e"].size > 0:
        raise expected(path, "a system with ẋ or x⁺ alone on its left side", f"the descriptor system {name}")
    time_base = system["lti"].flat[0]
    table = {key: system[key.lower()] for key in "ABCD"}
    table["Ts"] = time_base["tsam"]
    for key, labels in (
        ("states", system["stname"]),
        ("inputs", time_base["inname"]),
        ("outputs", time_base["outname"]),
    ):
        names = of_v5(path, name, labels)
        if names and all(names):
            table[key] = names
    return table


def load_v73(path, data):
    """Version 7.3 is HDF5: every array transposed, text as numbers, cells as references."""
    try:
        import h5py
    except ImportError:
        raise needs("h5py", "reading a .mat file of version 7.3 (or save it with -v7)", "mat73") from None
    with h5py.File(io.BytesIO(data), "r") as file:
        reader = ReaderV73(path, file)
        return {name: reader.member(file, name) for name in file if not name.startswith("#")}


class ReaderV73:
    """Counts what it reads: cells and structures may have the same item many times, and themselves."""

    def __init__(self, path, file):
        self.path, self.file = path, file
        self.numbers, self.arrays = 0, 0

    def member(self, group, name, depth=0):
        """HDF5's links may lead to other files, and its arrays may lie there."""
        import h5py

        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            raise expected(self.path, "variables of its own", f"{name}, which is a link to another")
        return self.value(group[name], depth)

    def value(self, item, depth):
        import h5py

        check_depth(self.path, depth)
        kind = class_of(item)
        if isinstance(item, h5py.Group):
            self.count(item.name, ())
            fields = {key: self.member(item, key, depth + 1) for key in item}
            return one_by_one(fields) if all(is_field_of_many(item[key]) for key in item) else fields
        if not isinstance(item, h5py.Dataset) or item.external or item.is_virtual:
            raise expected(self.path, "matrices", f"{item.name[1:]}, which has its numbers elsewhere")
        if item.dtype.itemsize > LARGEST_ENTRY:
            raise expected(self.path, "matrices", f"{item.name[1:]}, an entry of which has {item.dtype.itemsize} bytes")
        check_size(self.path, item.name, item.chunks or ())
        self.count(item.name, item.shape or (0,))
        if "MATLAB_empty" in item.attrs:
            return "" if kind == "char" else [] if kind == "cell" else item[:0]
        value = item[()].T
        if value.dtype == object:
            return [self.value(self.file[reference], depth + 1) for reference in value.flat]
        if kind == "char":
            return "".join(chr(code) for code in value.flat)
        if value.dtype.names == ("real", "imag"):
            return value["real"] + 1j * value["imag"]
        if value.dtype.kind not in "fiub" or "MATLAB_object_decode" in item.attrs:
            raise expected(self.path, "matrices", f"{item.name[1:]} of the class {kind or value.dtype}")
        return value

    def count(self, name, shape):
        check_size(self.path, name, shape)
        self.numbers += math.prod(shape)
        self.arrays += 1
        if self.arrays > MOST_ARRAYS or self.numbers > MOST_NUMBERS:
            raise expected(self.path, f"at most {MOST_ARRAYS} arrays of {MOST_NUMBERS} numbers together", "more")


def class_of(item):
    kind = item.attrs.get("MATLAB_class", b"")
    return kind.decode() if isinstance(kind, bytes) else str(kind)


def is_field_of_many(item):
    """References to the values of a field in an array of structures; those of a cell have a class."""
    return getattr(item, "dtype", None) == object and "MATLAB_class" not in item.attrs


def one_by_one(fields):
    """An array of structures, which HDF5 has field by field."""
    return [dict(zip(fields, values)) for values in zip(*fields.values())]
