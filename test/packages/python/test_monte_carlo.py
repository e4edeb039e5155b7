# SPDX-License-Identifier: MIT
"""Many runs: the same in parts as at once, with bounds that those of scipy are."""

import concurrent.futures
import unittest

import numpy
import scipy.stats

import tinylqg
from designs import SOURCE, InFolder
from tinylqg import monte_carlo as module
from tinylqg.quantile import chi_squared_quantile
from tinylqg.simulation import simulated

SERVO = SOURCE / "codegen" / "designs" / "servo.toml"
INTEGRATING = SOURCE / "test" / "designs" / "integrating_servo.toml"  # whose filter expects what the plant does
STEP = {
    "name": "step",
    "duration": 0.1,
    "reference": [{"output": "angle", "value": 0.02, "at": 0.01}],
    "spread": {"A": 0.1, "B": 0.1},
}


class Many(InFolder):
    def assert_same(self, one, other):
        self.assertEqual((one.name, one.runs, one.seed, one.failed), (other.name, other.runs, other.seed, other.failed))
        self.assertEqual((one.nees, one.nis), (other.nees, other.nis))
        numpy.testing.assert_array_equal(one.column("steps[0].overshoot"), other.column("steps[0].overshoot"))
        for percent in (5, 50, 95):
            self.assertEqual(repr(one.percentiles[percent]), repr(other.percentiles[percent]))

    def test_parts_are_the_whole(self):
        design = tinylqg.Design.load(SERVO)
        whole = design.monte_carlo(600, seed=3, scenario=STEP, progress=False)
        with concurrent.futures.ProcessPoolExecutor(2) as executor:
            self.assert_same(whole, design.monte_carlo(600, seed=3, scenario=STEP, executor=executor))
        self.assertEqual(whole.runs, 600)
        self.assertEqual(len(whole.numbers), 600)

    def test_what_is_joined_here_is_what_lqgen_says(self):
        for name in ("servo", "two_mass", "range_tracker"):
            design = tinylqg.Design.load(SERVO.with_name(name + ".toml"))
            many = design.monte_carlo(60, progress=False)
            words = ("--seed", "1", "--runs", "60")
            if design.scenarios:
                words += ("--scenario", design.scenarios[0])
            said = simulated(design, *words)["monte_carlo"][0]
            self.assertEqual((many.name, many.failed), (said["name"], said["failed"]))
            for key in ("nees", "nis"):
                ours, theirs = getattr(many, key), said.get(key)
                self.assertEqual(ours is None, theirs is None, name)
                if ours:
                    numpy.testing.assert_allclose(list(ours.values()), list(theirs.values()), rtol=1e-12)
            for percent, theirs in said["percentiles"].items():
                self.assert_same_numbers(many.percentiles[int(percent)], theirs, name)

    def assert_same_numbers(self, ours, theirs, where):
        if isinstance(theirs, dict):
            self.assertEqual(list(ours), list(theirs), where)
            for key in theirs:
                self.assert_same_numbers(ours[key], theirs[key], f"{where}.{key}")
        elif isinstance(theirs, list):
            self.assertEqual(len(ours), len(theirs), where)
            for one, other in zip(ours, theirs):
                self.assert_same_numbers(one, other, where)
        else:
            self.assertEqual(ours, float("inf") if theirs is None else theirs, where)

    def test_a_seed_makes_the_runs(self):
        design = tinylqg.Design.load(SERVO)
        one, same, other = (design.monte_carlo(20, seed=seed, scenario=STEP) for seed in (1, 1, 2))
        self.assert_same(one, same)
        self.assertNotEqual(one.column("cost").tobytes(), other.column("cost").tobytes())
        self.assertEqual(len(set(one.column("cost"))), 20)

    def test_percentiles_are_nearest_ranks(self):
        many = tinylqg.Design.load(SERVO).monte_carlo(40, scenario=STEP)
        costs = numpy.sort(many.column("cost"))
        self.assertEqual([many.percentiles[p].cost for p in (5, 50, 95)], [costs[1], costs[19], costs[37]])
        overshoots = numpy.sort(many.column("steps[0].overshoot"))
        self.assertEqual(many.percentiles[95].steps[0].overshoot, overshoots[37])

    def test_the_filter_knows_its_error_unless_the_plant_is_another(self):
        design = tinylqg.Design.load(INTEGRATING)
        right = design.monte_carlo(200, scenario={"duration": 0.2})
        self.assertEqual(right.nees.expected, 2)
        self.assertEqual(right.nis.expected, 1)
        self.assertGreater(right.nees.share_inside, 0.85)
        low, high = scipy.stats.chi2.ppf([0.025, 0.975], 200 * 2) / 200
        numpy.testing.assert_allclose((right.nees.low, right.nees.high), (low, high), rtol=1e-10)
        loud = design.monte_carlo(200, scenario={"duration": 0.2, "sensor": [{"output": "angle", "bias": 0.01}]})
        self.assertLess(loud.nees.share_inside, 0.2)

    def test_runs_that_miss_what_is_required_have_failed(self):
        design = tinylqg.Design.load(SERVO)
        self.assertEqual(design.monte_carlo(10, scenario=STEP).failed, 0)
        wild = design.monte_carlo(10, scenario={**STEP, "plant": {"delay": 0.01}, "duration": 5})
        self.assertEqual(wild.failed, wild.failures.mean())

    def test_what_is_no_number_of_runs(self):
        design = tinylqg.Design.load(SERVO)
        for runs in (0, -1, 1.5, True, "10"):
            with self.refused("runs"):
                design.monte_carlo(runs, scenario=STEP)


class Parts(unittest.TestCase):
    """Without lqgen: what is joined of parts."""

    def test_sums_of_parts_are_the_sum_of_all(self):
        parts = [{"sums": {"nees": sums}} for sums in ([2**60, 1], [1, 2, 3], [])]
        self.assertEqual(module.joined("nees", parts), [2**60 + 1, 3, 3])

    def test_what_is_not_reached_is_infinite(self):
        tables = [{"settling_time": value, "names": "x"} for value in (0.1, None, 0.2, None)]
        self.assertEqual(module.percentiles_of(tables, 50), {"settling_time": 0.2, "names": "x"})
        self.assertEqual(module.percentiles_of(tables, 95)["settling_time"], float("inf"))

    def test_quantiles_are_those_of_scipy(self):
        for degrees in (1, 2, 3, 10, 101, 4000, 250000):
            for p in (0.001, 0.025, 0.5, 0.975, 0.999):
                self.assertAlmostEqual(
                    chi_squared_quantile(p, degrees) / scipy.stats.chi2.ppf(p, degrees), 1, delta=1e-11
                )

    def test_consistency_of_normal_numbers(self):
        draws = numpy.random.default_rng(5).normal(size=(400, 300, 3))
        sums = [int(total) for total in numpy.rint((draws**2).sum(axis=(0, 2)) * module.SCALE)]
        found = module.consistency(sums, [400] * 300, 3)
        self.assertAlmostEqual(found.mean, 3, delta=0.02)
        self.assertAlmostEqual(found.share_inside, 0.95, delta=0.04)
        self.assertIsNone(module.consistency([], [], 3))


if __name__ == "__main__":
    unittest.main()
