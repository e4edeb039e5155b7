# SPDX-License-Identifier: MIT
"""The name of a design, which names its files: what it may be, and which one a design file says."""

import re
from pathlib import Path

from .errors import expected, refusing

try:
    import tomllib
except ImportError:  # Python before 3.11
    import tomli as tomllib

NAME = re.compile(r"[a-z][a-z0-9_]{0,30}")


def design_name(name, where="name"):
    """`name`, which is a C identifier in lower case: it begins names of files and symbols. lqgen checks the rest."""
    if not isinstance(name, str) or not NAME.fullmatch(name):
        raise expected(
            where,
            "at most 31 lower-case letters, digits and _, a letter first",
            repr(name) if isinstance(name, str) else f"{type(name).__name__} {name!r}",
        )
    return name


def name_in(path):
    """The name that the design file says."""
    text = Path(path).read_bytes()
    with refusing(path, "a design file"):
        return design_name(tomllib.loads(text.decode("utf-8-sig")).get("name"), f"{path}: name")
