# SPDX-License-Identifier: MIT
"""What lqgen says about a design that it makes."""

import re
from typing import NamedTuple, Optional

NOTE = re.compile(r"(?:(?P<place>\S.*?:\d+:\d+): )?note: (?P<key>[^:]+): (?P<message>.*)")


class Finding(NamedTuple):
    """A note of lqgen about a design that it makes."""

    key: str
    """The key that it is about: "limits.u_max[0]"."""
    message: str
    place: Optional[str] = None
    """FILE:LINE:COLUMN, of a design that was loaded from a file."""


def findings_in(said):
    """Those in lqgen's lines."""
    found = [NOTE.fullmatch(line) for line in said.splitlines()]
    return [Finding(note["key"], note["message"], note["place"]) for note in found if note]
