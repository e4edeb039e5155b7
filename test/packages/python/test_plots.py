# SPDX-License-Identifier: MIT
"""Pictures show the design's own numbers: the margins that lqgen reports can be read off them."""

import os
import unittest

os.environ["MPLBACKEND"] = "Agg"

import matplotlib.pyplot
import numpy

import tinylqg
from designs import SOURCE, InFolder
from tinylqg.frequency import frequencies, loop_gain, one_at_a_time


def load(name):
    return tinylqg.Design.load(SOURCE / "codegen" / "designs" / f"{name}.toml")


class Plots(InFolder):
    def tearDown(self):
        matplotlib.pyplot.close("all")

    def test_phase_margin_and_crossover_are_on_the_bode_plot(self):
        for name in ("servo", "two_mass", "ball_and_beam", "quadrotor", "oven"):
            design = load(name)
            gain, phase = design.plot("bode").axes
            found = []
            inputs = len(design.solve().plant.inputs)
            for line, angle in list(zip(gain.lines, phase.lines))[:inputs]:
                w, size = line.get_data()
                (crossings,) = numpy.nonzero(numpy.diff(numpy.sign(size - 1)))
                found += [(abs((angle.get_ydata()[k] + 180) % 360), w[k]) for k in crossings]
            margin, crossover = min((min(at, 360 - at), w) for at, w in found)
            self.assertAlmostEqual(margin, design.margins.phase_margin_deg, delta=1, msg=name)
            self.assertAlmostEqual(crossover / design.margins.crossover, 1, delta=0.01, msg=name)

    def test_disk_margin_is_the_distance_that_the_loop_keeps(self):
        """α = min |2 (1 + L)/(1 − L)|, Seiler, Packard, Gahinet 2020."""
        for name in ("servo", "two_mass", "ball_and_beam"):
            design = load(name)
            w = frequencies(design.solve(), 20000)
            L = one_at_a_time(loop_gain(design.solve(), w))[:, 0]
            self.assertAlmostEqual(abs(2 * (1 + L) / (1 - L)).min(), design.margins.disk_margin, places=3, msg=name)

    def test_nyquist_stays_out_of_its_disk(self):
        design = load("servo")
        (axes,) = design.plot("nyquist").axes
        (disk,) = [patch for patch in axes.patches if patch.get_path().vertices.shape[0] > 100]
        corners = disk.get_path().vertices
        centre = (corners[:, 0].max() + corners[:, 0].min()) / 2
        radius = (corners[:, 0].max() - corners[:, 0].min()) / 2
        real, imaginary = axes.lines[0].get_data()
        nearest = numpy.hypot(real - centre, imaginary).min()
        self.assertGreater(nearest, radius * 0.999)
        self.assertLess(nearest, radius * 1.01)

    def test_poles_are_those_of_the_result(self):
        design = load("range_tracker")
        (axes,) = design.plot("poles").axes
        shown = {line.get_label(): line.get_xdata() + 1j * line.get_ydata() for line in axes.lines}
        numpy.testing.assert_array_equal(shown["kalman"], design.solve().kalman.poles)
        self.assertNotIn("lqr", shown)

    def test_response_shows_the_run(self):
        design = load("servo")
        scenario = {"duration": 0.2, "reference": [{"output": "angle", "value": 0.05, "at": 0.01}]}
        run = design.simulate(scenario, seed=3)
        figure = design.plot("response", scenario=scenario, seed=3)
        outputs, inputs, angle, speed = figure.axes
        numpy.testing.assert_array_equal(outputs.lines[0].get_ydata(), run.outputs[:, 0])
        numpy.testing.assert_array_equal(inputs.lines[0].get_ydata(), run.u[:, 0])
        self.assertEqual([line.get_ydata()[0] for line in inputs.lines[1:]], [-12, 12])
        numpy.testing.assert_array_equal(speed.lines[1].get_ydata(), run.estimate[:, 1])
        figure.savefig("response.png")

    def test_what_cannot_be_drawn(self):
        with self.refused("kind", '"response" or "bode" or "nyquist" or "poles"'):
            load("servo").plot("root locus")
        with self.refused("range_tracker", "estimator alone"):
            load("range_tracker").plot("bode")
        with self.refused('plot("bode")', "seed"):
            load("servo").plot("bode", seed=1)


if __name__ == "__main__":
    unittest.main()
