#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes states.h, the states of a design's header whose samples cost the most: worst.py <build> DESIGN.toml NUMBER

NUMBER random states are looked at. The header is there, too, below the current folder. CC is the compiler.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "foresight"))
from foresight import prepare, run


def main() -> int:
    build, design, number = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), int(sys.argv[3])
    prepare(build, design, "float", program="worst", folder=HERE)
    done = run("./worst", number)
    Path("states.h").write_text(done.stdout)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
