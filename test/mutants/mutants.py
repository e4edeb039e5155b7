#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Changes emitted headers and the library, one place at a time, and asks whether their tests notice.

    mutants.py <build> header DESIGN.toml STYLE [--sample N]    the header that lqgen makes, by its own NAME_test.c
    mutants.py <build> src [FILE.c…] [--sample N]               src/*.c, by test/src/test_*.c

A mutant of which the compiler makes the same code at -O2 is no mutant. One that survives has to stand in
equivalent.txt, with a reason. --sample N takes N of them, evenly. Everything is written below the current folder. CC is
the compiler.

Exit status 0: all others are killed; 1: some survive; 2: something is not there.
"""

import argparse
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from mutate import Mutant, mutants

ROOT = Path(__file__).resolve().parents[2]
CC = shlex.split(os.environ.get("CC", "cc"))
LEFT_OUT = ("test_consistency", "test_contract")  # one is slow, the other needs a library that asserts
SANITIZERS = [
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
]  # who survives without them is asked with them
SECONDS = 20  # a mutant that takes longer hangs


def stop(why: str) -> None:
    print(why, file=sys.stderr)
    sys.exit(2)


def run(*command) -> subprocess.CompletedProcess:
    return subprocess.run(
        [str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False
    )


def passes(program: Path) -> bool:
    try:
        return (
            subprocess.run(
                [program.absolute()], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=SECONDS, check=False
            ).returncode
            == 0
        )
    except subprocess.TimeoutExpired:
        return False


def need(*command) -> None:
    done = run(*command)
    if done.returncode:
        stop(f"{shlex.join(map(str, command))}:\n{done.stdout.decode()[:2000]}")


class Equivalent:
    """Lines of equivalent.txt: a regular expression of the file, of the line, of what became of it; the reason behind
    #."""

    def __init__(self):
        self.known = []
        for line in (Path(__file__).parent / "equivalent.txt").read_text().splitlines():
            if line and not line.startswith("#"):
                file, before, after = (part.strip() for part in line.split(" # ")[0].split(" => "))
                self.known.append([re.compile(part) for part in (file, before, after)])

    def has(self, file: str, mutant: Mutant) -> bool:
        found = (file, mutant.before.strip(), mutant.after.strip())
        return any(all(part.fullmatch(text) for part, text in zip(known, found)) for known in self.known)


class Header:
    """One emitted header and its test."""

    def __init__(self, build: Path, design: Path, style: str):
        lqgen = build / "codegen" / "lqgen"
        if not lqgen.exists():
            stop(f"Not found: {lqgen}")
        need(lqgen, design, "-o", ".", "--only", "h,test", "--quiet", "--style", style)
        self.test = next(Path().glob("*_test.c"))
        header = Path(self.test.name.replace("_test.c", ".h"))
        self.texts = {header: header.read_text()}
        fused = "Arithmetic: fused" in self.texts[header]
        self.options = options(build) + (["-DLQG_FUSED"] if fused and style == "compact" else [])
        library = sorted((ROOT / "src").glob("*.c")) if style == "compact" else []
        self.objects = [compiled(file, self.options) for file in [unity(build) / "unity.c", *library]]

    def passes(self, *options: str) -> bool | None:
        built = run(*CC, *self.options, *options, self.test, *self.objects, "-lm", "-o", "program")
        return None if built.returncode else passes(Path("program"))

    def code(self, file: Path) -> bytes:
        run(*CC, *self.options, "-O2", "-c", self.test, "-o", "code.o")
        return Path("code.o").read_bytes()

    def survives(self, file: Path) -> bool | None:
        return self.passes("-O0") and self.passes("-O1", *SANITIZERS)  # None: no C


class Library:
    """Files of src/ and the tests of test/src: float, plain."""

    def __init__(self, build: Path, names: list[str]):
        tests = ROOT / "test" / "src"
        self.options = [*options(build), "-I", tests]
        for header in (ROOT / "src").glob("*.h"):
            Path(header.name).write_text(header.read_text())
        sources = sorted((ROOT / "src").glob("*.c"))
        self.objects = {Path(file.name): compiled(file, self.options) for file in sources}
        self.texts = {Path(file.name): file.read_text() for file in sources if not names or file.name in names}
        for file, text in self.texts.items():
            file.write_text(text)
        helpers = [
            file for file in sorted(tests.glob("*.c")) if file.stem in ("model", "textbook", "loop", "bits", "limited")
        ]
        self.helpers = [compiled(file, self.options, "helper_") for file in [unity(build) / "unity.c", *helpers]]
        names_of_tests = [file for file in sorted(tests.glob("test_*.c")) if file.stem not in LEFT_OUT]
        self.tests = [compiled(file, self.options) for file in names_of_tests]
        # What lies behind an array of a test is watched only if the test is compiled so, too.
        self.watched = {
            built: compiled(file, [*self.options, "-O1", *SANITIZERS], "watched_")
            for built, file in zip(self.tests, names_of_tests)
        }

    # Tests of the file's own name first: they kill most.
    def tests_for(self, file: Path) -> list[Path]:
        return sorted(self.tests, key=lambda test: file.stem.split("_")[0] not in test.stem)

    def code(self, file: Path) -> bytes:
        run(*CC, *self.options, "-O2", "-c", file, "-o", "code.o")
        return Path("code.o").read_bytes()

    def survives(self, file: Path) -> bool | None:
        return self.passes(file, "-O1") and self.passes(file, "-O1", *SANITIZERS)  # None: no C

    def passes(self, file: Path, *options: str) -> bool | None:
        if run(*CC, *self.options, *options, "-c", file, "-o", "mutant.o").returncode:
            return None
        others = [built for name, built in self.objects.items() if name != file]
        for test in self.tests_for(file):
            test = self.watched[test] if options[1:] else test
            need(*CC, *options, test, "mutant.o", *others, *self.helpers, "-lm", "-o", "program")
            if not passes(Path("program")):
                return False
        return True


def unity(build: Path) -> Path:
    for line in (build / "CMakeCache.txt").read_text().splitlines():
        if line.startswith("FETCHCONTENT_SOURCE_DIR_UNITY:") and line.split("=", 1)[1]:
            return Path(line.split("=", 1)[1]) / "src"
    found = build / "_deps" / "unity-src" / "src"
    return found if found.exists() else stop("Not found: Unity's sources")


def options(build: Path) -> list:
    return ["-std=c99", "-w", "-DUNITY_INCLUDE_DOUBLE", "-I", ".", "-I", ROOT / "include", "-I", unity(build)]


def compiled(file: Path, options: list, prefix: str = "") -> Path:
    made = Path(prefix + file.stem + ".o")
    need(*CC, *options, "-O1", "-c", file, "-o", made)
    return made


def ask(subject, sample: int) -> int:
    equivalent, killed, same, known, alive = Equivalent(), 0, 0, 0, 0
    every = [(file, mutant) for file, text in subject.texts.items() for mutant in mutants(text)]
    step = max(1, -(-len(every) // sample)) if sample else 1
    for file in subject.texts:
        if not subject.survives(file):
            stop(f"{file}: its test does not pass before anything is changed")
    original = {file: subject.code(file) for file in subject.texts}
    for file, mutant in every[::step]:
        file.write_text(mutant.apply(subject.texts[file]))
        survives = subject.survives(file)
        if survives is None:
            pass  # no C
        elif not survives:
            killed += 1
        elif subject.code(file) == original[file]:
            same += 1
        elif equivalent.has(file.name, mutant):
            known += 1
        else:
            alive += 1
            print(
                f"{file}:{mutant.line + 1}: survives\n  - {mutant.before.strip()}\n  + {mutant.after.strip()}",
                flush=True,
            )
        file.write_text(subject.texts[file])
    count = killed + known + alive
    print(
        f"{killed} of {count} mutants killed, {known} listed as equivalent, {alive} survive; "
        f"{same} more are the same code"
    )
    return 1 if alive or not killed else 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("what", choices=["header", "src"])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--sample", type=int, default=0)
    given = parser.parse_args()
    build = given.build.resolve()
    if given.what == "src":
        return ask(Library(build, given.names), given.sample)
    design, style = given.names
    return ask(Header(build, Path(design).resolve(), style), given.sample)


if __name__ == "__main__":
    sys.exit(main())
