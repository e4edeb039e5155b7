# SPDX-License-Identifier: MIT
"""Runs of scenarios: what the compiled controller makes of the same samples, and what the plant makes of its inputs."""

import pickle
import unittest

import numpy

import tinylqg
from designs import DESIGNS, SOURCE, InFolder

STEP = {"duration": 0.3, "reference": [{"output": "angle", "value": 0.05, "at": 0.02}]}


def load(name):
    return tinylqg.Design.load(SOURCE / "codegen" / "designs" / f"{name}.toml")


class Runs(InFolder):
    def test_compiled_controllers_make_the_same_of_every_sample(self):
        for file in DESIGNS:
            design = tinylqg.Design.load(file)
            run = design.simulate()
            with design.controller() as controller:
                kind = controller.kind
                measured = run.y if kind.has_filter else run.estimate
                for k in range(len(run.t)):
                    if kind.measured == "x" and kind.measured_size != measured.shape[1]:
                        break  # inputs on their way are not in a Run
                    given = {"u": run.u[k]} if kind.is_estimator and kind.inputs else {}
                    if kind.references:
                        given["r"] = run.r[k]
                    u = controller.step(measured[k], **given)
                    if not kind.is_estimator:
                        numpy.testing.assert_array_equal(u, run.u[k], f"{file.name} {k}")
                    numpy.testing.assert_array_equal(
                        controller.x[: run.estimate.shape[1]], run.estimate[k], f"{file.name} {k}"
                    )
                    self.assertEqual(
                        {name for name in controller.status if not name[-1].isdigit()},
                        {name for name in run.events[k] if not name[-1].isdigit()},
                        f"{file.name} {k}",
                    )

    def test_the_plant_is_the_designs_own(self):
        """Without noise x⁺ = A x + B u and y = C x."""
        design = load("servo")
        run = design.simulate({**STEP, "noise": False})
        plant = design.solve().plant
        A, B, C = plant.A[:2, :2], plant.B[:2], plant.C[:, :2]  # without the disturbance, which is the filter's
        following = run.x[:-1] @ A.T + run.u[:-1] @ B.T
        numpy.testing.assert_allclose(run.x[1:], following, rtol=1e-9, atol=1e-12)
        numpy.testing.assert_allclose(run.outputs, run.x @ C.T, rtol=1e-12, atol=1e-15)
        self.assertEqual(run.x.shape, (len(run.t), 2))
        numpy.testing.assert_allclose(numpy.diff(run.t), 0.001, rtol=1e-9)

    def test_it_is_where_it_was_told_to_be(self):
        run = load("servo").simulate({**STEP, "noise": False})
        self.assertAlmostEqual(run.outputs[-1, 0], 0.05, places=3)
        numpy.testing.assert_array_equal(run.r[:, 0], numpy.where(run.t < 0.02 - 1e-9, 0, 0.05))
        (step,) = run.numbers.steps
        self.assertEqual((step.output, step["to"]), ("angle", 0.05))
        self.assertAlmostEqual(step.overshoot, max(0, run.outputs.max() / 0.05 - 1), delta=0.01)

    def test_missing_outputs_are_nan_and_told(self):
        run = load("servo").simulate({**STEP, "dropout": [{"output": "angle", "from": 0.1, "until": 0.105}]})
        missing = numpy.isnan(run.y[:, 0])
        self.assertEqual(missing.sum(), 5)
        for k, events in enumerate(run.events):
            self.assertEqual("output_rejected" in events, missing[k])
        self.assertEqual(run.numbers.left_out[0], 5)

    def test_same_seed_same_bits(self):
        design = load("servo")
        one, same, other = (design.simulate(STEP, seed=seed) for seed in (4, 4, 5))
        self.assertEqual(one.x.tobytes(), same.x.tobytes())
        self.assertNotEqual(one.x.tobytes(), other.x.tobytes())

    def test_the_filter_knows_its_error(self):
        run = load("servo").simulate({"duration": 5})
        late = slice(200, None)
        error = (run.x - run.estimate)[late]
        inside = (abs(error) < 3 * run.sigma[late]).mean(axis=0)
        self.assertTrue((inside > 0.985).all(), inside)
        self.assertAlmostEqual(run.nees[late].mean(), 2, delta=0.3)
        self.assertAlmostEqual(run.nis[late].mean(), 1, delta=0.15)

    def test_scenarios_by_name_and_in_the_design(self):
        design = load("servo").replace(scenario=[{"name": "a", "duration": 0.01}, {"name": "b b", "duration": 0.02}])
        self.assertEqual(design.scenarios, ["a", "b b"])
        self.assertEqual([len(design.simulate(name).t) for name in (None, "a", "b b")], [10, 10, 20])
        step = {"name": "a", "duration": 0.2, "noise": False, "reference": STEP["reference"]}
        design = design.replace({"scenario[0]": step, "require.scenario": "a", "require.overshoot": 0.5})
        self.assertEqual(len(design.simulate({"name": "c", "duration": 0.03}).t), 30)
        self.assertEqual(len(design.simulate({**step, "duration": 0.25}).t), 250)
        again = tinylqg.Design(
            A=[[0.9]],
            B=[[1]],
            domain="discrete",
            sample_time=1,
            Q=1,
            R=1,
            scenario={"name": "s", "duration": 5, "x0": [1]},
        )
        self.assertEqual(len(again.simulate().t), 5)
        self.assertIsNone(again.simulate().sigma)
        with self.refused("--scenario", '"a", "b b"', '"c"'):
            design.simulate("c")
        with self.refused("scenario", "a name or a dictionary"):
            design.simulate(1)
        with self.refused("seed"):
            design.simulate(seed=-1)
        with self.refused("durration", "duration"):
            design.simulate({"durration": 1})

    def test_columns_and_pickles(self):
        run = load("servo").simulate(STEP)
        columns = run.columns()
        self.assertEqual(list(columns)[:3], ["t", "x angle [rad]", "x speed [rad/s]"])
        numpy.testing.assert_array_equal(columns["u voltage [V]"], run.u[:, 0])
        self.assertEqual({len(column) for column in columns.values()}, {len(run.t)})
        again = pickle.loads(pickle.dumps(run))
        self.assertEqual(again.x.tobytes(), run.x.tobytes())
        self.assertEqual(again.numbers.cost, run.numbers.cost)


if __name__ == "__main__":
    unittest.main()
