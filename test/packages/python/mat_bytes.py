# SPDX-License-Identifier: MIT
"""Files of MATLAB 5 and 7 byte by byte, for what no program writes."""

import struct
import zlib

MATRIX, COMPRESSED = 14, 15
CELL, STRUCTURE, SPARSE, DOUBLE = 1, 2, 5, 6


def element(kind, data):
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def array(kind, rest, name=b"", shape=(1, 1)):
    flags = element(6, struct.pack("<II", kind, 4))
    return element(MATRIX, flags + element(5, struct.pack("<2i", *shape)) + element(1, name) + rest)


def number(value, name=b""):
    return array(DOUBLE, element(9, struct.pack("<d", value)), name)


def structure(inside, name=b""):
    """With the one field a."""
    return array(STRUCTURE, struct.pack("<HHI", 5, 4, 8) + element(1, b"a".ljust(8, b"\0")) + inside, name)


def cell(inside, name=b""):
    return array(CELL, inside, name)


def nested(outer, depth, name):
    inside = number(1.0)
    for _ in range(depth):
        inside = outer(inside)
    return outer(inside, name)


def sparse(rows, name):
    """2 × 2, whose entries say that they are in these rows."""
    data = (
        element(5, struct.pack("<2i", *rows))
        + element(5, struct.pack("<3i", 0, 1, 2))
        + element(9, struct.pack("<2d", 1, 1))
    )
    return array(SPARSE, data, name, (2, 2))


def compressed(element_bytes):
    data = zlib.compress(element_bytes)
    return struct.pack("<II", COMPRESSED, len(data)) + data


def file_of(*elements):
    return b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x0100) + b"IM" + b"".join(elements)
