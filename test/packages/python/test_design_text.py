# SPDX-License-Identifier: MIT
"""Design files of python-control's, scipy's and plain matrices."""

import json
import random
import struct
import tomllib
import unittest
from pathlib import Path

import control
import numpy
import scipy.signal

import tinylqg
from designs import DESIGNS, InFolder

A, B, C, D = [[0, 1], [0, -2]], [[0], [3]], [[1, 0]], [[0]]
WEIGHTS = {"Q": [10, 0.1], "R": [0.1], "W": [1, 1], "V": [1e-5]}


def any_double(source):
    """A double of any mantissa, of a size that a plant can be made of."""
    while True:
        value = struct.unpack("<d", source.randbytes(8))[0]
        if 1e-3 < abs(value) < 1:
            return value


class Plants(InFolder):
    def designed(self, plant, **keys):
        """The design that lqgen makes, and with which domain and sample time."""
        tinylqg.write_design("loop.toml", plant, **{**WEIGHTS, **keys})
        return tinylqg.generate("loop.toml")

    def assert_same_gains(self, designs):
        for design in designs[1:]:
            numpy.testing.assert_array_equal(design.K, designs[0].K)
            numpy.testing.assert_array_equal(design.L, designs[0].L)

    def test_continuous_plants_of_all_tools_give_the_same_gains(self):
        plants = [
            control.ss(A, B, C, D),
            scipy.signal.StateSpace(A, B, C, D),
            scipy.signal.lti(A, B, C, D),
            {"domain": "continuous", "A": A, "B": B, "C": C},
        ]
        designs = [self.designed(plant, sample_time=0.01) for plant in plants]
        designs.append(self.designed((numpy.array(A), B, C), domain="continuous", sample_time=0.01))
        self.assertEqual(designs[0].plant.domain, "continuous")
        self.assert_same_gains(designs)

    def test_discrete_plants_of_all_tools_give_the_same_gains(self):
        sampled = scipy.signal.cont2discrete(tuple(map(numpy.array, (A, B, C, D))), 0.01)
        plants = [
            control.ss(*sampled),
            scipy.signal.StateSpace(*sampled[:4], dt=0.01),
            scipy.signal.dlti(*sampled[:4], dt=0.01),
            sampled,
        ]
        designs = [self.designed(plant) for plant in plants]
        designs.append(self.designed(sampled[:4], domain="discrete", sample_time=0.01))
        self.assertEqual((designs[0].plant.domain, designs[0].plant.sample_time), ("discrete", 0.01))
        self.assert_same_gains(designs)

    def test_numbers_read_back_exactly(self):
        source = random.Random(20)
        for nx in (1, 2, 3, 5, 8):
            F = numpy.array([[any_double(source) for _ in range(nx)] for _ in range(nx)])
            G = numpy.array([[any_double(source)] for _ in range(nx)])
            design = self.designed(
                (F, G, numpy.eye(nx)),
                domain="discrete",
                sample_time=1 / 3,
                Q=numpy.eye(nx),
                R=[1],
                W=numpy.eye(nx),
                V=numpy.eye(nx),
                code={"real": "double"},
            )
            self.assertEqual(design.plant.A.tobytes(), F.tobytes())
            self.assertEqual(design.plant.B.tobytes(), G.tobytes())
            self.assertEqual(design.plant.sample_time, 1 / 3)

    def test_float32_is_written_as_the_double_that_it_is(self):
        design = self.designed(
            (numpy.array([[0.1]], dtype=numpy.float32), [[1]], [[1]]),
            domain="discrete",
            sample_time=1,
            Q=[1],
            R=[1],
            W=[1],
            V=[1],
        )
        self.assertEqual(design.plant.A[0, 0], float(numpy.float32(0.1)))

    def test_labels_become_names(self):
        plant = control.ss(A, B, C, D, states=["angle [rad]", "speed"], inputs=["u [V]"], outputs=["y"])
        design = self.designed(plant, sample_time=0.01)
        self.assertEqual(design.plant.states, ["angle [rad]", "speed"])
        self.assertEqual(design.plant.inputs, ["u [V]"])
        self.assertEqual(design.plant.outputs, ["y"])
        back = design.to_control()
        self.assertEqual(
            (back.state_labels, back.input_labels, back.output_labels, back.dt),
            (["angle [rad]", "speed"], ["u [V]"], ["y"], 0.01),
        )

    def test_labels_that_python_control_made_up_leave_lqgens_names(self):
        self.assertEqual(self.designed(control.ss(A, B, C, D), sample_time=0.01).plant.states, ["x0", "x1"])
        two = control.append(control.ss(A, B, C, D, name="left"), control.ss([[-1]], [[1]], [[1]], 0, name="right"))
        text = tinylqg.design_text(two, name="two", sample_time=0.01)
        self.assertNotIn("[0]_", text)

    def test_names_given_by_hand_replace_labels(self):
        plant = control.ss(A, B, C, D, states=["a.b", "c d"])
        self.assertEqual(self.designed(plant, sample_time=0.01, states=["ab", "cd"]).plant.states, ["ab", "cd"])

    def test_transfer_function_of_scipy(self):
        design = self.designed(scipy.signal.lti([3], [1, 2, 0]), sample_time=0.01)
        self.assertEqual(design.plant.A.shape, (2, 2))

    def test_estimator_and_regulator_alone(self):
        estimator = self.designed((A, None, C), domain="continuous", sample_time=0.01, Q=None, R=None)
        self.assertNotIn("lqr", estimator)
        self.assertEqual(estimator.plant.B.shape, (2, 0))
        regulator = self.designed((A, B), domain="continuous", sample_time=0.01, W=None, V=None)
        self.assertNotIn("kalman", regulator)
        self.assertEqual(regulator.plant.C.shape, (0, 2))

    def test_every_design_of_the_tree_passes_through(self):
        """All keys of all sections: the file is taken apart, made again, and gives the same numbers."""
        self.assertGreater(len(DESIGNS), 10)
        for design in DESIGNS:
            tables = tomllib.loads(design.read_text(encoding="utf-8"))
            tinylqg.write_design("again.toml", **tables)
            results = []
            for file in (design, "again.toml"):
                tinylqg.generate(file)
                results.append(json.loads(Path(tables["name"] + ".json").read_text(encoding="utf-8")))
                del results[-1]["design_file"]
            self.assertEqual(results[0], results[1], design.name)

    def test_letters_words_and_infinities(self):
        brief = 'the "loop" of Größe ψ'
        design = self.designed(
            (A, B, C),
            domain="continuous",
            sample_time=0.01,
            brief=brief,
            limits={"u_min": [-float("inf")], "u_max": numpy.array([12.5])},
        )
        self.assertEqual(design.brief, brief)


class Refusals(InFolder):
    def test_sample_time_of_a_continuous_plant_is_asked_for(self):
        for plant in (control.ss(A, B, C, D), scipy.signal.StateSpace(A, B, C, D)):
            with self.refused("plant.sample_time", "continuous"):
                tinylqg.design_text(plant, name="x")

    def test_unknown_time_base(self):
        for plant in (control.ss(A, B, C, D, True), scipy.signal.dlti(A, B, C, D)):
            with self.refused("plant.dt", "expected", "True"):
                tinylqg.design_text(plant, name="x", sample_time=0.1)
        with self.refused("plant.dt", "None"):
            tinylqg.design_text(control.ss(A, B, C, D, None), name="x", sample_time=0.1)
        with self.refused("plant.domain"):
            tinylqg.design_text((A, B, C, D), name="x", sample_time=0.1)

    def test_contradictions(self):
        with self.refused("plant.sample_time", "expected 0.1", "found 0.2"):
            tinylqg.design_text(control.ss(A, B, C, D, 0.1), name="x", sample_time=0.2)
        with self.refused("plant.domain", "continuous"):
            tinylqg.design_text(control.ss(A, B, C, D), name="x", sample_time=0.2, domain="discrete")
        with self.refused("lqr.Q", "twice"):
            tinylqg.design_text(control.ss(A, B, C, D, 0.1), name="x", Q=[1, 1], lqr={"Q": [1, 1]})

    def test_what_is_no_plant_or_no_section(self):
        with self.refused("plant", "builtins.str"):
            tinylqg.design_text("A", name="x")
        with self.refused("FrequencyResponseData"):
            tinylqg.design_text(control.frd([1, 2], [1, 2]), name="x", sample_time=0.1)
        with self.refused("kalmann: unknown", "kalman="):
            tinylqg.design_text((A, B, C, D, 0.1), name="x", kalmann={})

    def test_what_is_no_number(self):
        for wrong in (True, numpy.array([True]), None):
            with self.refused("kalman.gate", "expected a number"):
                tinylqg.design_text((A, B, C, D, 0.1), name="x", kalman={"gate": [wrong]})


class Text(unittest.TestCase):
    def test_whole_numbers_are_integers_where_they_are_exact(self):
        text = tinylqg.design_text(([[2.0, -0.0], [2.0**53, 1e300]], [[1], [0]], [[1, 0]], [[0]], 1), name="x")
        self.assertIn("A = [[2, -0.0],\n     [9007199254740992, 1e+300]]", text)
        self.assertIn("sample_time = 1\n", text)


if __name__ == "__main__":
    unittest.main()
