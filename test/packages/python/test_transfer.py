# SPDX-License-Identifier: MIT
"""Transfer functions: the state space has their answer over frequency, few states, and those that are promised."""

import random
import unittest

import control
import numpy
import scipy.signal

import tinylqg
from designs import InFolder


def matrices(plant, **keys):
    return {key: numpy.array(value) for key, value in tinylqg.Design(plant, **keys).tables["plant"].items()}


class Transfer(InFolder):
    def assert_same_answer(self, plant, found):
        z = numpy.exp(0.37j) if plant.dt else 0.37j
        n = len(found["A"])
        answer = found["C"] @ numpy.linalg.solve(z * numpy.eye(n) - found["A"], found["B"]) + found["D"]
        numpy.testing.assert_allclose(answer, numpy.atleast_2d(plant(z)), rtol=1e-9, atol=1e-12)

    def test_without_zeros_the_states_are_the_output_and_its_derivatives(self):
        found = matrices(control.tf([6], [2, 4, 8, 0]), sample_time=0.1)
        numpy.testing.assert_array_equal(found["A"], [[0, 1, 0], [0, 0, 1], [0, -4, -2]])
        numpy.testing.assert_array_equal(found["B"], [[0], [0], [3]])
        numpy.testing.assert_array_equal(found["C"], [[1, 0, 0]])
        self.assertEqual(list(found["states"]), ["y", "y_dot", "y_dot2"])
        found = matrices(scipy.signal.dlti([1], [1, 0.2, 0.4], dt=0.5))
        self.assertEqual(
            (list(found["states"]), found["domain"], found["sample_time"]), (["y", "y_next"], "discrete", 0.5)
        )

    def test_with_zeros_the_first_state_is_the_output(self):
        plant = control.tf([3, 1, 2], [1, 4, 5, 6])
        found = matrices(plant, sample_time=0.1)
        numpy.testing.assert_array_equal(found["C"], [[1, 0, 0]])
        numpy.testing.assert_array_equal(found["B"], [[3], [1], [2]])
        self.assertNotIn("states", found)
        self.assert_same_answer(plant, found)

    def test_any_of_one_input_and_output(self):
        source = random.Random(4)
        for case in range(200):
            n = source.randint(1, 6)
            a = [1 + source.random(), *(source.uniform(-2, 2) for _ in range(n))]
            b = [source.uniform(-2, 2) for _ in range(source.randint(1, n + 1))]
            plant = control.tf(b, a, source.choice([0, 0.1]))
            found = matrices(plant, **({} if plant.dt else {"sample_time": 0.1}))
            self.assertEqual(len(found["A"]), n, case)
            self.assert_same_answer(plant, found)

    def test_what_cancels_is_no_state(self):
        found = matrices(control.tf([1, 3, 2], [1, 6, 11, 6]), sample_time=0.1)  # (s+1)(s+2) / (s+1)(s+2)(s+3)
        numpy.testing.assert_allclose(found["A"], [[-3]], rtol=1e-6)
        found = matrices(scipy.signal.ZerosPolesGain([1], [1, 0.5], 2, dt=1))
        numpy.testing.assert_allclose(found["A"], [[0.5]], rtol=1e-6)

    def test_several_inputs_and_outputs_are_minimal(self):
        # Residues: at −1 [[1, 1], [0, 3]], at −2 [[0, 0], [1, 0]]: 2 + 1 states, by McMillan.
        plant = control.tf([[[1], [1, 2]], [[1], [3]]], [[[1, 1], [1, 1]], [[1, 2], [1, 1]]])
        found = matrices(plant, sample_time=0.1)
        self.assertEqual(len(found["A"]), 3)
        self.assert_same_answer(plant, found)

    def test_random_systems_keep_their_order_and_answer(self):
        source = numpy.random.default_rng(7)
        for n in (1, 2, 3, 4):
            A = numpy.diag(source.uniform(-2, -0.1, n))
            B, C = source.normal(size=(n, 2)), source.normal(size=(2, n))
            entries = [[numpy.poly(A.diagonal()) for _ in range(2)] for _ in range(2)]
            tops = [
                [sum(C[i, k] * B[k, j] * numpy.poly(numpy.delete(A.diagonal(), k)) for k in range(n)) for j in range(2)]
                for i in range(2)
            ]
            plant = control.tf(tops, entries)
            found = matrices(plant, sample_time=0.1)
            self.assertEqual(len(found["A"]), n)
            self.assert_same_answer(plant, found)

    def test_design_of_a_transfer_function(self):
        design = tinylqg.Design(control.tf([3], [1, 2, 0]), sample_time=0.01, Q=[10, 0.1], R=0.1)
        again = tinylqg.Design(
            control.ss([[0, 1], [0, -2]], [[0], [3]], [[1, 0]], 0), sample_time=0.01, Q=[10, 0.1], R=0.1
        )
        numpy.testing.assert_array_equal(design.K, again.K)

    def test_what_has_no_state_space(self):
        with self.refused("entry (0, 0)", "at most as many zeros as poles, 1, found 2"):
            tinylqg.Design(control.tf([1, 0, 0], [1, 1]), sample_time=0.1)
        with self.refused("with a pole"):
            tinylqg.Design(control.tf([2], [1], 0), sample_time=0.1)
        with self.refused("plant.sample_time", "continuous"):
            tinylqg.Design(control.tf([1], [1, 1]))


if __name__ == "__main__":
    unittest.main()
