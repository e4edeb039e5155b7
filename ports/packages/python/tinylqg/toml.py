"""The text of a design file. Every number reads back as the double that it was."""

import math
import re

from .errors import expected

LARGEST_EXACT_INTEGER = 2**53


def number(value, where):
    """0.1 as 0.1, 3.0 as 3: where an integer is asked for, a float is none."""
    if isinstance(value, int) and not isinstance(value, bool):
        return str(value)
    if isinstance(value, float):
        if math.isnan(value) or math.isinf(value):
            return str(value)
        is_minus_zero = value == 0 and math.copysign(1, value) < 0
        if value.is_integer() and abs(value) <= LARGEST_EXACT_INTEGER and not is_minus_zero:
            return str(int(value))
        return repr(value)
    if isinstance(value, complex):
        return f"[{number(value.real, where)}, {number(value.imag, where)}]"  # a pole
    raise expected(where, "a number", repr(value))


def string(value):
    """A basic string: quotes, backslashes and control characters escaped."""
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + re.sub(r"[\x00-\x1f\x7f]", lambda c: f"\\u{ord(c[0]):04x}", escaped) + '"'


def plain(value):
    """NumPy's arrays and scalars, and tuples, as lists and numbers of Python."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return value


def is_matrix(value):
    return isinstance(value, list) and len(value) > 1 and all(isinstance(row, list) for row in value)


def inline(value, where):
    """A value on one line."""
    if isinstance(value, str):
        return string(value)
    if isinstance(value, dict):
        items = [f"{key} = {inline(plain(item), f'{where}.{key}')}" for key, item in value.items() if item is not None]
        return "{ " + ", ".join(items) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(inline(item, where) for item in value) + "]"
    return number(value, where)


def assignment(key, value, where):
    """`key = value`, the rows of a matrix under each other."""
    value = plain(value)
    start = f"{key} = "
    one_line = start + inline(value, where)
    if not is_matrix(value) or all(len(row) == 1 for row in value):
        return one_line
    rows = [inline(row, where) for row in value]
    return start + "[" + (",\n" + " " * (len(start) + 1)).join(rows) + "]"


def table(header, entries, where):
    lines = [assignment(key, value, f"{where}.{key}") for key, value in entries.items() if value is not None]
    return "\n".join([header, *lines]) + "\n"


def document(top, tables):
    """The whole file: `top` before `tables`; a table that is a list of dictionaries is an array of tables."""
    parts = ["\n".join(assignment(key, value, key) for key, value in top.items() if value is not None) + "\n"]
    for name, entries in tables.items():
        if isinstance(entries, dict):
            parts.append(table(f"[{name}]", entries, name))
        else:
            parts += [table(f"[[{name}]]", item, f"{name}[{i}]") for i, item in enumerate(entries)]
    return "\n".join(parts)
