# SPDX-License-Identifier: MIT
"""The text of a design file. Every number reads back as the double that it was, every text as what it was."""

import math
import re

from .errors import expected

LARGEST_EXACT_INTEGER = 2**53
LARGEST_INTEGER = 2**63 - 1  # of TOML
DEEPEST = 12  # lists and tables in each other; a design file needs 5
BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")


def number(value, where):
    """0.1 as 0.1, 3.0 as 3: where an integer is asked for, a float is none."""
    if isinstance(value, int) and not isinstance(value, bool):
        if abs(value) > LARGEST_INTEGER:
            raise expected(where, "an integer of 64 bits", f"one of {value.bit_length() + 1}")
        return str(int(value))
    if isinstance(value, float):
        if math.isnan(value) or math.isinf(value):
            return str(float(value))
        is_minus_zero = value == 0 and math.copysign(1, value) < 0
        if value.is_integer() and abs(value) <= LARGEST_EXACT_INTEGER and not is_minus_zero:
            return str(int(value))
        return repr(float(value))
    if isinstance(value, complex):
        return f"[{number(value.real, where)}, {number(value.imag, where)}]"  # a pole
    raise expected(where, "a number", f"{type(value).__name__} {value!r}")


def string(value, where):
    """A basic string: quotes, backslashes and control characters escaped. UTF-8 has no halves of characters."""
    half = re.search("[\ud800-\udfff]", value)
    if half:
        raise expected(where, "a text of Unicode's characters", half[0])
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + re.sub(r"[\x00-\x1f\x7f]", lambda c: f"\\u{ord(c[0]):04x}", escaped) + '"'


def key(name, where):
    """A key as it is, or in quotes where it has other characters than a bare one may have."""
    if not isinstance(name, str):
        raise expected(where, "a text as the key", f"{type(name).__name__} {name!r}")
    return name if BARE_KEY.fullmatch(name) else string(name, where)


def plain(value, where, depth=0):
    """NumPy's arrays and scalars, and tuples, as lists and numbers of Python; tables without what is None."""
    if depth > DEEPEST:
        raise expected(where, f"lists and tables at most {DEEPEST} in each other", "more")
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item, where, depth + 1) for item in value]
    if isinstance(value, dict):
        return {name: plain(item, f"{where}.{name}", depth + 1) for name, item in value.items() if item is not None}
    return value


def is_matrix(value):
    return isinstance(value, list) and len(value) > 1 and all(isinstance(row, list) for row in value)


def inline(value, where):
    """A plain value on one line."""
    if isinstance(value, str):
        return string(value, where)
    if isinstance(value, dict):
        items = [f"{key(name, where)} = {inline(item, f'{where}.{name}')}" for name, item in value.items()]
        return "{ " + ", ".join(items) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(inline(item, where) for item in value) + "]"
    if isinstance(value, bool) and where.startswith("scenario["):  # nothing else has truth values
        return "true" if value else "false"
    return number(value, where)


def assignment(name, value, where):
    """`name = value`, the rows of a matrix under each other."""
    value = plain(value, where)
    start = f"{key(name, where)} = "
    one_line = start + inline(value, where)
    if not is_matrix(value) or all(len(row) == 1 for row in value):
        return one_line
    rows = [inline(row, where) for row in value]
    return start + "[" + (",\n" + " " * (len(start) + 1)).join(rows) + "]"


def table(header, entries, where):
    lines = [assignment(name, value, f"{where}.{name}") for name, value in entries.items() if value is not None]
    return "\n".join([header, *lines]) + "\n"


def document(top, tables):
    """The whole file: `top` before `tables`; a table that is a list of dictionaries is an array of tables."""
    parts = ["\n".join(assignment(name, value, name) for name, value in top.items() if value is not None) + "\n"]
    for name, entries in tables.items():
        if isinstance(entries, dict):
            parts.append(table(f"[{key(name, name)}]", entries, name))
        else:
            parts += [table(f"[[{key(name, name)}]]", item, f"{name}[{i}]") for i, item in enumerate(entries)]
    return "\n".join(parts)


def whole_document(tables):
    """The whole file of what a parser of TOML has made of one."""
    top = {name: value for name, value in tables.items() if not is_table(value)}
    return document(top, {name: value for name, value in tables.items() if is_table(value)})


def is_table(value):
    return isinstance(value, dict) or (isinstance(value, list) and len(value) > 0 and isinstance(value[0], dict))
