# SPDX-License-Identifier: MIT
"""A design for every combination of values, here or by an executor."""

import concurrent.futures
import unittest

import joblib.externals.loky
import numpy

import tinylqg
from designs import SOURCE, InFolder

SERVO = SOURCE / "codegen" / "designs" / "servo.toml"
VALUES = {"rho": [0.1, 1, 10], "kalman.measurement_noise[0]": [1e-7, 1e-6]}


class Recorder:
    """An executor that has nothing but what is asked for."""

    def __init__(self):
        self.count = 0

    def submit(self, function, *arguments):
        self.count += 1
        future = concurrent.futures.Future()
        future.set_result(function(*arguments))
        return future


class Sweeps(InFolder):
    def test_every_combination_in_order(self):
        sweep = tinylqg.Design.load(SERVO).sweep(VALUES)
        self.assertEqual(
            [tuple(point.values.values()) for point in sweep],
            [(rho, v) for rho in VALUES["rho"] for v in VALUES["kalman.measurement_noise[0]"]],
        )
        for point in sweep:
            self.assertEqual(point.design.tables["lqr"]["bryson"]["rho"], point.values["rho"])
            numpy.testing.assert_array_equal(point.result.K, point.design.K)
        table = sweep.table("loop.phase_margin_deg", "loop.rms.u[0]", "lqr.K[0][1]")
        self.assertEqual(list(table), [*VALUES, "loop.phase_margin_deg", "loop.rms.u[0]", "lqr.K[0][1]"])
        self.assertEqual(table["lqr.K[0][1]"][3], sweep[3].result.K[0, 1])
        self.assertTrue((numpy.diff(table["loop.rms.u[0]"][::2]) < 0).all())  # dearer inputs are smaller

    def test_executors_give_the_same(self):
        design = tinylqg.Design.load(SERVO)
        here = design.sweep(VALUES)
        recorder = Recorder()
        with concurrent.futures.ThreadPoolExecutor(2) as threads:
            for executor in (recorder, threads, joblib.externals.loky.get_reusable_executor(max_workers=2)):
                there = design.sweep(VALUES, executor=executor)
                for one, other in zip(here, there):
                    self.assertEqual((one.values, one.design, one.error), (other.values, other.design, other.error))
                    numpy.testing.assert_array_equal(one.result.K, other.result.K)
        self.assertEqual(recorder.count, len(here))

    def test_what_cannot_be_designed_says_why(self):
        sweep = tinylqg.Design.load(SERVO).sweep({"require.phase_margin_deg": [30, 80]}, rho=[1])
        self.assertIsNone(sweep[0].error)
        self.assertIsNone(sweep[1].result)
        self.assertIn("require.phase_margin_deg", sweep[1].error)
        margins = sweep.column("loop.phase_margin_deg")
        self.assertEqual(list(numpy.isnan(margins)), [False, True])
        self.assertTrue(numpy.isnan(sweep.column("loop.wibble")).all())

    def test_whole_matrices_are_values(self):
        sweep = tinylqg.Design.load(SERVO).sweep(
            A=[[[0, 1], [0, -50]], numpy.array([[0, 1], [0, -70]])], progress=False
        )
        self.assertEqual([point.design.tables["plant"]["A"][1][1] for point in sweep], [-50, -70])

    def test_what_is_no_list(self):
        design = tinylqg.Design.load(SERVO)
        with self.refused("sweep", "found none"):
            design.sweep()
        with self.refused("sweep: rho", "a list of values"):
            design.sweep(rho=1)
        with self.refused("did you mean rho"):
            design.sweep(roh=[1])

    def test_progress_is_shown_when_asked_for(self):
        import contextlib
        import io

        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            tinylqg.Design.load(SERVO).sweep(rho=[1, 2], progress=True)
        self.assertIn("2/2", said.getvalue())
        said.truncate(0)
        with contextlib.redirect_stderr(said):
            tinylqg.Design.load(SERVO).sweep(rho=[1, 2])
        self.assertEqual(said.getvalue().strip("\x00"), "")


if __name__ == "__main__":
    unittest.main()
