# SPDX-License-Identifier: MIT
"""The wheel's lqgen is the build's, with nothing in between; headers and sources are there."""

import os
import sys
import unittest
from pathlib import Path

import tinylqg
from designs import BUILT_LQGEN, DESIGNS, SOURCE, InFolder, run

LQGEN = Path(sys.executable).parent / "lqgen"
IMPOSSIBLE = """name = "impossible"
[plant]
domain = "discrete"
sample_time = 1
A = [[2, 0], [0, 0.5]]
B = [[0], [1]]
[lqr]
Q = [1, 1]
R = [1]
"""


class Lqgen(InFolder):
    def test_makes_the_bytes_of_the_build(self):
        for design in DESIGNS[:4]:
            for program, folder in ((LQGEN, "wheel"), (BUILT_LQGEN, "build")):
                Path(folder).mkdir(exist_ok=True)
                done = run(program, design, "-o", folder)
                self.assertEqual(done.returncode, 0, done.stderr)
        names = sorted(os.listdir("build"))
        self.assertEqual(len(names), 16)
        self.assertEqual(sorted(os.listdir("wheel")), names)
        for name in names:
            self.assertEqual(Path("wheel", name).read_bytes(), Path("build", name).read_bytes(), name)

    def test_exit_status_and_streams_are_the_programs(self):
        Path("impossible.toml").write_text(IMPOSSIBLE)
        Path("wrong.toml").write_text("name = 1\n")
        for status, arguments in (
            (0, ["--version"]),
            (0, ["--help"]),
            (1, ["impossible.toml"]),
            (2, ["wrong.toml"]),
            (2, ["--no-such-option"]),
            (2, []),
            (3, ["missing.toml"]),
        ):
            wheel, build = run(LQGEN, *arguments), run(BUILT_LQGEN, *arguments)
            self.assertEqual(wheel.returncode, status, arguments)
            self.assertEqual(
                (wheel.returncode, wheel.stdout, wheel.stderr), (build.returncode, build.stdout, build.stderr)
            )

    def test_needs_what_every_linux_has(self):
        needed = run("ldd", tinylqg.lqgen_path()).stdout
        self.assertIn("libc.so", needed)
        for library in ("mpfr", "gmp"):
            self.assertNotIn(library, needed)

    def test_version_is_that_of_the_package(self):
        self.assertEqual(run(LQGEN, "--version").stdout.strip(), tinylqg.__version__)

    def test_headers_and_sources_are_those_of_the_tree(self):
        for made, folder, pattern in (
            (tinylqg.include_dir(), SOURCE / "include", "lqg/*.h"),
            (tinylqg.source_dir(), SOURCE / "src", "*.[ch]"),
        ):
            expected = {path.relative_to(folder): path.read_bytes() for path in folder.glob(pattern)}
            found = {path.relative_to(made): path.read_bytes() for path in made.glob(pattern)}
            self.assertGreater(len(expected), 5)
            self.assertEqual(found, expected)

    def test_compact_controller_builds_with_the_packages_sources(self):
        tinylqg.generate(SOURCE / "codegen" / "designs" / "two_mass.toml", ".", "--style", "compact")
        Path("main.c").write_text(
            '#include "two_mass.h"\nint main(void)\n{\n    two_mass_t loop;\n    float u[1];\n'
            "    const float y[2] = {1, 1};\n    two_mass_init(&loop);\n"
            "    return two_mass_step(&loop, y, u) == LQG_OK && u[0] < 0 ? 0 : 1;\n}\n"
        )
        sources = sorted(tinylqg.source_dir().glob("*.c"))
        done = run(
            os.environ.get("CC", "cc"),
            "-std=c99",
            "-I.",
            f"-I{tinylqg.include_dir()}",
            "main.c",
            *sources,
            "-o",
            "main",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(run("./main").returncode, 0)

    def test_refusals_come_with_all_their_lines(self):
        Path("wrong.toml").write_text('name = "wrong"\n[plant]\nsample_time = 0\nA = [[1]]\nc = [[1]]\n')
        with self.refused("wrong.toml:3:", "plant.sample_time", "wrong.toml:5:", "did you mean `C`?"):
            tinylqg.generate("wrong.toml")
        with self.assertRaisesRegex(OSError, "missing.toml"):
            tinylqg.generate("missing.toml")
        self.assertEqual(os.listdir("."), ["wrong.toml"])


if __name__ == "__main__":
    unittest.main()
