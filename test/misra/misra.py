#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks src/, include/ and emitted headers by the MISRA C:2012 addon of cppcheck against the deviations in README.md.

Fails for a finding that no row of the table covers, and for a row that no finding needs.
"""

import argparse
import fnmatch
import pathlib
import re
import shutil
import subprocess
import sys

# Between them: each filter, each kind of law, both forms, stages, delays, limits, ranges, both reals, fused and plain.
DESIGNS = {
    "codegen/designs": ["balancing_robot", "dc_motor", "oven", "quadrotor", "range_tracker", "servo"],
    "test/designs": ["alone", "bias", "gated", "horizon", "modal", "slew_limit", "stages_schedule"],
}
ONLY = {"modal": ["unrolled"], "stages_schedule": ["compact"]}
FINDING = re.compile(r"^(?P<file>[^:]*):(?P<line>\d+):.*misra-c2012-(?P<rule>\d+\.\d+)")
ROW = re.compile(r"^\| (?P<rule>\d+\.\d+) \| (?P<files>`[^|]*`) \| (?P<reason>[^|]*\S) \|$")


def rows_of(readme):
    """(rule, pattern) of each deviation; a row may name several patterns."""
    rows = []
    for line in readme.read_text(encoding="utf-8").splitlines():
        match = ROW.match(line)
        if match:
            rows += [(match["rule"], pattern) for pattern in re.findall(r"`([^`]*)`", match["files"])]
    return rows


def emit(lqgen, root, output):
    """The headers, each in a folder of its style: [(path, options of the compiler)]."""
    made = []
    for folder, names in DESIGNS.items():
        for name in names:
            for style in ONLY.get(name, ["unrolled", "compact"]):
                into = output / style
                into.mkdir(parents=True, exist_ok=True)
                design = root / folder / (name + ".toml")
                subprocess.run([lqgen, design, "-o", into, "--only", "h", "--quiet", "--style", style], check=True)
                text = (into / (name + ".h")).read_text(encoding="utf-8")
                options = ["-DLQG_FUSED"] if "Arithmetic: fused" in text else []
                options += ["-DLQG_REAL_DOUBLE"] if re.search(r"\bdouble [xyzu]\[", text) else []
                made.append((into / (name + ".h"), options))
    return made


def findings(cppcheck, output, path, options):
    """{(file, rule): a line} of what is found in a file and in what it includes."""
    command = [
        cppcheck,
        "--std=c99",
        "--language=c",
        "--addon=misra",
        "--quiet",
        "--template={file}:{line}: {id}",
        f"-I{output / 'include'}",
        f"-I{output / 'src'}",
        *options,
        path,
    ]
    result = subprocess.run(command, check=False, capture_output=True, text=True)
    found = {}
    for line in (result.stdout + result.stderr).splitlines():
        match = FINDING.match(line)
        if match:
            file = pathlib.Path(match["file"]).resolve().relative_to(output)
            found[file.as_posix(), match["rule"]] = match["line"]
    if result.returncode != 0:
        sys.exit(f"cppcheck failed for {path}: {result.stdout}{result.stderr}")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for option in ("cppcheck", "lqgen", "root", "output"):
        parser.add_argument("--" + option, required=True, type=pathlib.Path)
    arguments = parser.parse_args()
    root, output = arguments.root.resolve(), arguments.output.resolve()
    for folder in ["src", "include"]:  # cppcheck writes files beside those that it reads
        shutil.rmtree(output / folder, ignore_errors=True)
        shutil.copytree(root / folder, output / folder)
    variants = [[], ["-DLQG_REAL_DOUBLE", "-DLQG_FUSED"]]
    files = [(path, options) for path in sorted((output / "src").glob("*.c")) for options in variants]
    files += [(output / "include/lqg/functions.h", [])]  # which no source includes
    files += emit(arguments.lqgen, root, output)
    found = {}
    for path, options in files:
        found.update(findings(arguments.cppcheck, output, path, options))
    if not found:
        sys.exit("nothing was found at all: does the addon work?")
    rows = rows_of(root / "test/misra/README.md")
    used = set()
    failed = False
    for (file, rule), line in sorted(found.items()):
        covering = [row for row in rows if row[0] == rule and fnmatch.fnmatch(file, row[1])]
        used.update(covering)
        if not covering:
            print(f"{file}:{line}: rule {rule}, which has no row in test/misra/README.md")
            failed = True
    for rule, pattern in rows:
        if (rule, pattern) not in used:
            print(f"test/misra/README.md: nothing needs the deviation from rule {rule} for {pattern}")
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
