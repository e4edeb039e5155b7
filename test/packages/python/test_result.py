# SPDX-License-Identifier: MIT
"""NAME.json as python-control's, scipy's and NumPy's own."""

import functools
import json
import tempfile
import unittest
from pathlib import Path

import control
import numpy
import scipy.linalg

import tinylqg
from designs import DESIGNS, SOURCE, InFolder


@functools.lru_cache(maxsize=None)
def design_of(file):
    """What lqgen makes of the design file."""
    with tempfile.TemporaryDirectory() as folder:
        return tinylqg.generate(file, folder)


def polynomial(poles, count):
    """The coefficients of `count` poles, those that are missing at 0."""
    return numpy.poly([*poles, *[0] * (count - len(poles))])


class Loops(InFolder):
    def test_plant_and_controller_close_the_loop_that_lqgen_reports(self):
        closed = 0
        for file in DESIGNS:
            design = design_of(file)
            if "lqr" not in design or "added_states" in design.plant:  # a disturbance is a pole at 1 of no loop
                continue
            loop = control.feedback(design.to_control("sensed"), design.to_control("controller"), sign=+1)
            # Where y is made of the input before, plant and controller keep it both: poles at 0 that lqgen's loop has
            # not.
            count = loop.nstates
            self.assertIn(count - len(design.loop.poles), (0, len(design.plant.inputs) * (design.plant.D.any() + 1)))
            # A coefficient of n poles within the unit circle is at most binomial(n, n/2), n 4.5e-16 of which is
            # rounding.
            error = abs(polynomial(loop.poles(), count) - polynomial(design.loop.poles, count)).max()
            self.assertLess(error, 1e-14 * 2.0**count, file.name)
            closed += 1
        self.assertGreater(closed, 10)

    def test_outputs_follow_their_references(self):
        for name in ("slew_limit", "delayed", "alone"):
            design = design_of(SOURCE / "test" / "designs" / f"{name}.toml")
            plant, controller = design.to_control("sensed"), design.to_control("controller", references=True)
            final = numpy.real(closed_with_reference(plant, controller).dcgain()).reshape(-1)
            self.assertAlmostEqual(final[design.lqr.references[0]], 1, delta=1e-9, msg=name)

    def test_gain_is_the_riccati_solutions_of_the_sampled_plant(self):
        design = design_of(SOURCE / "codegen" / "designs" / "two_mass.toml")
        A, B, C, G = (design.plant[key] for key in "ABCG")
        cost, noise = design.cost, design.noise
        X = scipy.linalg.solve_discrete_are(A, B, cost.Q, cost.R, s=cost.N)
        K = numpy.linalg.solve(cost.R + B.T @ X @ B, B.T @ X @ A + cost.N.T)
        numpy.testing.assert_allclose(design.K, K, rtol=1e-9)
        P = scipy.linalg.solve_discrete_are(A.T, C.T, G @ noise.W @ G.T, noise.V)
        L = P @ C.T @ numpy.linalg.inv(C @ P @ C.T + noise.V)
        numpy.testing.assert_allclose(design.L, L, rtol=1e-9, atol=1e-12)

    def test_scipy_gets_the_same_systems(self):
        design = design_of(SOURCE / "codegen" / "designs" / "oven.toml")
        for part in ("plant", "sensed", "controller"):
            ours, theirs = design.to_control(part), design.to_scipy(part)
            self.assertEqual(theirs.dt, 1)
            for key in "ABCD":
                numpy.testing.assert_array_equal(getattr(theirs, key), getattr(ours, key))

    def test_every_signal_has_a_name_of_its_own(self):
        for file in DESIGNS:
            design = design_of(file)
            for part in ("plant", "sensed", "controller")[: 3 if "lqr" in design else 2]:
                matrices, names = design.state_space(part)
                sizes = {"states": len(matrices[0]), "inputs": matrices[1].shape[1], "outputs": len(matrices[2])}
                for key, size in sizes.items():
                    self.assertEqual(len(set(names[key])), size, f"{file.name}: {part}.{key}")

    def test_states_that_the_filter_adds_have_their_names(self):
        for name in ("disturbed", "delayed"):
            design = design_of(SOURCE / "test" / "designs" / f"{name}.toml")
            found = design.state_space("plant")[1]["states"]
            added = design.plant.get("added_states", [])
            self.assertEqual(found[: len(design.plant.states) + len(added)], [*design.plant.states, *added])
        self.assertIn("torque_disturbance [N m]", design_of(SOURCE / "test/designs/disturbed.toml").plant.added_states)


class Files(InFolder):
    def test_every_number_of_the_file_is_there(self):
        for file in DESIGNS[:3]:
            tinylqg.generate(file)
            name = file.stem
            expected = json.loads(Path(f"{name}.json").read_text(encoding="utf-8"))
            self.assert_same(tinylqg.load(f"{name}.json"), expected)

    def assert_same(self, found, expected, key=None):
        if isinstance(expected, dict):
            self.assertEqual(list(found), list(expected))
            for name in expected:
                self.assert_same(getattr(found, name), expected[name], name)
        elif isinstance(found, numpy.ndarray):
            plain = [[pole.real, pole.imag] for pole in found] if found.dtype == complex else found.tolist()
            self.assertEqual(plain, expected, key)
        else:
            self.assertEqual(found, expected, key)

    def test_what_a_design_does_not_have(self):
        design = design_of(SOURCE / "codegen" / "designs" / "range_tracker.toml")
        with self.assertRaisesRegex(AttributeError, "no lqr; it has name"):
            design.K
        with self.refused("range_tracker", "estimator alone"):
            design.to_control("controller")
        with self.refused("part", "compensator"):
            design.to_control("compensator")

    def test_filter_that_never_becomes_steady(self):
        A, B, C = [[0.9, 0.1, 0], [0, 0.95, 0], [0, 0, 1]], [[0], [0.1], [0]], [[1, 0, 1], [0, 1, 0]]
        tinylqg.write_design(
            "bias.toml",
            (A, B, C),
            domain="discrete",
            sample_time=0.1,
            G=[[0, 0], [1, 0], [0, 0]],
            W=[0.01, 0.01],
            V=[0.01, 0.04],
            Q=[1, 1, 0],
            R=[1],
            lqr={"horizon": 20},
            kalman={"gain": "online"},
        )
        design = tinylqg.generate("bias.toml")
        self.assertEqual(design.kalman, {"form": "filter"})
        with self.refused("bias", "never becomes steady"):
            design.to_control("controller")

    def test_other_files_are_refused(self):
        for name, text in (("a.json", "{"), ("b.json", "[1]"), ("c.json", '{"name": "c"}')):
            Path(name).write_text(text)
            with self.refused(name, "expected"):
                tinylqg.load(name)
        with self.assertRaises(FileNotFoundError):
            tinylqg.load("missing.json")


def closed_with_reference(plant, controller):
    """From r to y: the plant's y is the controller's first inputs, r its last ones."""
    ny = plant.noutputs
    A, B, C, D = controller.A, controller.B, controller.C, controller.D
    n, m = plant.nstates, controller.nstates
    to_u = numpy.hstack([D[:, :ny] @ plant.C, C])  # of [x; s], as the plant's D is 0
    states = numpy.block([[plant.A, numpy.zeros((n, m))], [B[:, :ny] @ plant.C, A]])
    states[:n] += plant.B @ to_u
    inputs = numpy.vstack([plant.B @ D[:, ny:], B[:, ny:]])
    return control.ss(
        states, inputs, numpy.hstack([plant.C, numpy.zeros((ny, m))]), numpy.zeros((ny, inputs.shape[1])), plant.dt
    )


if __name__ == "__main__":
    unittest.main()
