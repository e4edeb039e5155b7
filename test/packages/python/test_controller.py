# SPDX-License-Identifier: MIT
"""The emitted controller sample by sample: compiled and behind lqgen's pipe it is the same."""

import gc
import os
import random
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy

import tinylqg
from designs import DESIGNS, SOURCE, InFolder, run

REGULATOR = SOURCE / "codegen" / "commands" / "regulator.toml"
SERVO = SOURCE / "codegen" / "designs" / "servo.toml"


def sample(source, kind, k):
    """Numbers of any size, with outputs that are missing or absurd, and new references now and then."""
    y = [source.gauss(0, 1) * 10.0 ** source.randint(-3, 3) for _ in range(kind.measured_size)]
    if k % 17 == 3:
        y[0] = float("nan")
    if k % 53 == 7:
        y[-1] = 1e30
    given = {}
    if kind.references and k % 7 == 0:
        given["r"] = [source.gauss(0, 1) for _ in range(kind.references)]
    if kind.is_estimator and kind.inputs:
        given["u"] = [source.gauss(0, 1) for _ in range(kind.inputs)]
    return y, given


class Same(InFolder):
    def assert_same_controllers(self, design, samples=150):
        """Zeros may have another sign, as the emitted code may write −a − b as 0 − a − b."""
        source = random.Random(12)
        with design.controller(compiled=True) as one, design.controller(compiled=False) as other:
            told = set()
            for k in range(samples):
                if k == 100:
                    one.reset()
                    other.reset()
                y, given = sample(source, one.kind, k)
                numpy.testing.assert_array_equal(one.step(y, **given), other.step(y, **given), f"{design.name} {k}")
                numpy.testing.assert_array_equal(one.x, other.x, f"{design.name} {k}")
                self.assertEqual(one.status_bits, other.status_bits, f"{design.name} {k}")
                told.update(one.status)
            return told

    def test_every_design_in_both_precisions(self):
        kinds = set()
        for file in [*DESIGNS, REGULATOR]:
            for real in ("float", "double"):
                design = tinylqg.Design.load(file).replace({"code.real": real})
                self.assert_same_controllers(design)
            result = design.solve()
            kinds.add(
                ("lqr" in result, result.get("kalman", {}).get("form"), "compensator" in result, "stages" in result)
            )
        self.assertGreater(len(kinds), 6, kinds)

    def test_loops_of_the_library(self):
        told = set()
        for file in (SERVO, *(SOURCE / "test" / "designs" / f"{name}.toml" for name in ("gated", "alone", "bias"))):
            for real in ("float", "double"):
                for arithmetic in ("plain", "fused"):
                    code = {"code.style": "compact", "code.real": real, "code.arithmetic": arithmetic}
                    told |= self.assert_same_controllers(tinylqg.Design.load(file).replace(code))
        self.assertLessEqual({"output_rejected", "output_rejected_0", "output_gated", "input_limited"}, told)


class Steps(InFolder):
    def test_the_linear_law_and_filter(self):
        """x̂ ← x̂ + L (y − C x̂), u = −K x̂, x̂ ← A x̂ + B u, in double and without limits."""
        design = tinylqg.Design(
            A=[[1, 0.01], [0, 1]],
            B=[[5e-5], [0.01]],
            C=[[1, 0]],
            domain="discrete",
            sample_time=0.01,
            Q=[1, 1],
            R=1,
            W=[1e-4, 1e-2],
            V=1e-3,
            code={"real": "double"},
        )
        result = design.solve()
        x = numpy.zeros(2)
        for compiled in (True, False):
            with design.controller(compiled) as controller:
                x[:] = 0
                for k in range(50):
                    y = numpy.sin([0.1 * k])
                    x += result.L @ (y - result.plant.C @ x)
                    u = -result.K @ x
                    numpy.testing.assert_allclose(controller.step(y), u, rtol=1e-12, atol=1e-15)
                    numpy.testing.assert_allclose(controller.x, x, rtol=1e-12, atol=1e-15)
                    x = result.plant.A @ x + result.plant.B @ u
                self.assertEqual(controller.status, ())

    def test_a_loop_closed_by_hand_follows_its_reference(self):
        design = tinylqg.Design.load(SERVO)
        plant = design.solve().plant
        for compiled in (True, False):
            with design.controller(compiled) as controller:
                x, limited = numpy.array([0, 0, -0.5]), 0  # with a load of 0.5 V beside the input
                for _ in range(1000):
                    u = controller.step(plant.C @ x, r=0.5)
                    limited += "input_limited" in controller.status
                    x = plant.A @ x + plant.B @ u
                self.assertAlmostEqual(x[0], 0.5, places=4)
                self.assertGreater(limited, 3)

    def test_references_stay_and_reset_forgets(self):
        for compiled in (True, False):
            with tinylqg.Design.load(SERVO).controller(compiled) as controller:
                self.assertIsNone(controller.x)
                first = controller.step(0, r=1)
                self.assertEqual(controller.step(0), first)  # at the limit
                controller.reset()
                self.assertEqual((controller.x, controller.status), (None, ()))
                self.assertEqual(controller.step(0), 0)

    def test_estimator_gives_its_estimate(self):
        for compiled in (True, False):
            with tinylqg.Design.load(SOURCE / "codegen/designs/range_tracker.toml").controller(compiled) as controller:
                x = controller.step([1, None])
                self.assertIs(x, controller.x)
                self.assertEqual(controller.status, ("output_rejected", "output_rejected_1"))

    def test_two_of_one_design_do_not_meet(self):
        design = tinylqg.Design.load(SERVO)
        for compiled in (True, False):
            with design.controller(compiled) as one, design.controller(compiled) as other:
                one.step(0.3)
                self.assertEqual(other.step(0), 0)


class Refusals(InFolder):
    def test_sizes(self):
        for compiled in (True, False):
            with tinylqg.Design.load(SERVO).controller(compiled) as controller:
                for step, said in (
                    (lambda: controller.step([1, 2]), "y: expected 1 number, found 2"),
                    (lambda: controller.step(1, r=[]), "r: expected 1 number, found 0"),
                    (lambda: controller.step("1"), "y: expected numbers"),
                    (lambda: controller.step(1, u=2), "u: the controller makes it"),
                ):
                    with self.refused(said):
                        step()
                self.assertEqual(controller.step(0), 0)  # and it lives
            with tinylqg.Design.load(REGULATOR).controller(compiled) as controller:
                with self.refused("x: expected 2 numbers, found 1"):
                    controller.step(0)

    def test_closed(self):
        controller = tinylqg.Design.load(SERVO).controller(compiled=False)
        controller.close()
        controller.close()
        with self.refused("closed"):
            controller.step(0)

    def test_nothing_is_left_behind(self):
        folder = self.folder / "temporary"
        folder.mkdir()
        with mock.patch.object(tempfile, "tempdir", str(folder)):
            for compiled in (True, False):
                controller = tinylqg.Design.load(SERVO).replace({"name": "left"}).controller(compiled)
                controller.step(0)
                process = getattr(controller.engine, "process", None)
                del controller
                gc.collect()
                self.assertTrue(process is None or process.poll() is not None)
        self.assertEqual(list(folder.iterdir()), [])

    def test_without_a_compiler_lqgen_runs_it(self):
        design = tinylqg.Design.load(SERVO)
        with mock.patch.dict(os.environ, {"CC": "no-such-compiler"}):
            with self.assertRaisesRegex(OSError, "expected a C compiler"):
                design.controller(compiled=True)
            with design.controller() as controller:
                self.assertEqual(type(controller.engine).__name__, "Piped")
        with mock.patch.dict(os.environ, {"CC": "false"}), self.refused("does not compile here"):
            design.controller(compiled=True)


class Command(InFolder):
    """lqgen run, as other languages see it."""

    def answers(self, lines, *words):
        Path("in").write_text(lines)
        return run("bash", "-c", '"$0" run --quiet "$@" < in', tinylqg.lqgen_path(), *(words or (SERVO,)))

    def test_lines_are_answered(self):
        done = self.answers("0.1\n0.2, 1\r\nnan 1\nreset\n0x1.999999999999ap-4\n")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = done.stdout.splitlines()
        self.assertEqual(len(lines), 4)
        self.assertEqual(lines[0], lines[3])
        self.assertEqual([line.split()[0] for line in lines], ["-12", "12", "12", "-12"])
        self.assertEqual(int(lines[2].split()[-1]), 1 + 8 + 256)

    def test_wrong_lines_end_it(self):
        for line, said in (
            ("", "expected 1 number (y) or 2 (y, r), found 0"),
            ("1 2 3", "expected 1 number (y) or 2 (y, r), found 3"),
            ("1 x", 'expected 1 number (y) or 2 (y, r), or reset, found "x"'),
        ):
            done = self.answers(f"0\n{line}\n0\n")
            self.assertEqual((done.returncode, done.stderr), (2, f"standard input: line 2: {said}\n"))
            self.assertEqual(len(done.stdout.splitlines()), 1)

    def test_what_cannot_run(self):
        done = self.answers("", "-")
        self.assertEqual(done.returncode, 2)
        self.assertIn("standard input has the samples", done.stderr)
        self.assertEqual(self.answers("", "missing.toml").returncode, 3)
        Path("bad.toml").write_text('name = "bad"\n')
        self.assertEqual(self.answers("0\n", "bad.toml").returncode, 2)


if __name__ == "__main__":
    unittest.main()
