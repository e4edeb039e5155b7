# SPDX-License-Identifier: MIT
"""kconfig.py Kconfig: no warnings, and the symbols that the package's CMakeLists.txt reads, each with a help text."""

import pathlib
import re
import sys

import kconfiglib

path = pathlib.Path(sys.argv[1])
kconfig = kconfiglib.Kconfig(str(path), warn_to_stderr=False)
symbols = {symbol.name: symbol for symbol in kconfig.unique_defined_syms}
used = set(re.findall(r"CONFIG_(TINYLQG\w*)", (path.parent / "CMakeLists.txt").read_text()))

problems = list(kconfig.warnings)
if set(symbols) != used:
    problems.append(f"defined: {sorted(symbols)}, used: {sorted(used)}")
problems += [f"{name} has no help" for name, symbol in symbols.items() if not symbol.nodes[0].help]
sys.exit("\n".join(problems) or None)
