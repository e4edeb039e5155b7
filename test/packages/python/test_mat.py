# SPDX-License-Identifier: MIT
"""MATLAB's files, written here by scipy in MATLAB's format."""

import unittest
from pathlib import Path

import numpy

import tinylqg
from designs import InFolder
from plants import PLANT, WEIGHTS, cells, save


class Read(InFolder):
    def text_of(self, keys, **more):
        save("plant.mat", **{**PLANT, **keys})
        return tinylqg.design_text(**{"name": "x", "sample_time": 0.1, **tinylqg.read_mat("plant.mat"), **more})

    def test_every_variable_goes_to_its_key(self):
        save(
            "plant.mat",
            **PLANT,
            **{**WEIGHTS, "W": 1.0},
            G=[[0.0], [1]],
            H=[[0.5]],
            N=[[0.0], [0.1]],
            Swv=[[0.001]],
            x0=[[1.0], [2]],
            P0=numpy.eye(2),
            u_min=-1.0,
            u_max=1.0,
            u_rate=5.0,
            delay=0.05,
            states=cells("a [m]", "b"),
            inputs=cells("u"),
            outputs=cells("y"),
            name="servo",
            brief="a servo",
        )
        keys = tinylqg.read_mat("plant.mat")
        self.assertEqual(
            {section: list(table) for section, table in keys.items() if isinstance(table, dict)},
            {
                "plant": ["A", "B", "C", "D", "G", "H", "delay", "states", "inputs", "outputs", "domain"],
                "lqr": ["Q", "R", "N"],
                "kalman": ["process_noise", "measurement_noise", "cross_noise", "initial_state", "initial_covariance"],
                "limits": ["u_min", "u_max", "u_rate"],
            },
        )
        text = tinylqg.design_text(**keys, sample_time=0.1)
        for line in (
            'name = "servo"',
            'brief = "a servo"',
            "delay = 0.05",
            'states = ["a [m]", "b"]',
            'inputs = ["u"]',
            "D = [[0]]",
            "H = [[0.5]]",
            "N = [[0], [0.1]]",
            "initial_state = [1, 2]",
            "u_min = [-1]",
        ):
            self.assertIn(line + "\n", text)
        Path("servo.toml").write_text(text)
        self.assertEqual(tinylqg.generate("servo.toml").brief, "a servo")

    def test_gains_are_those_of_the_same_design_written_directly(self):
        save("plant.mat", **PLANT, **WEIGHTS)
        tinylqg.write_design("read.toml", **tinylqg.read_mat("plant.mat"), sample_time=0.01)
        tinylqg.write_design(
            "direct.toml",
            {key: numpy.atleast_2d(PLANT[key]) for key in "ABCD"},
            sample_time=0.01,
            **{key: numpy.atleast_2d(value) for key, value in WEIGHTS.items()},
        )
        numpy.testing.assert_array_equal(tinylqg.generate("read.toml").K, tinylqg.generate("direct.toml").K)

    def test_structures_are_sections(self):
        text = self.text_of(
            {
                "lqr": {
                    "bryson": {"states": [0.1, 1.0], "inputs": 5.0},
                    "horizon": 20.0,
                    "integral": {"outputs": 0.0, "Q": 2.0},
                },
                "kalman": {"gain": "online", "structure": numpy.array([[1.0], [0]])},
                "V": 1e-5,
                "code": {"real": "double", "flash": 4096.0},
                "observer": {"poles": numpy.array([0.1 + 0.2j, 0.1 - 0.2j])},
            }
        )
        for line in (
            "bryson = { states = [0.1, 1], inputs = [5] }",
            "horizon = 20",
            'gain = "online"',
            "flash = 4096",
            "integral = { outputs = [0], Q = [2] }",
            "structure = [[1], [0]]",
            "measurement_noise = [1e-05]",
            "poles = [[0.1, 0.2], [0.1, -0.2]]",
        ):
            self.assertIn(line + "\n", text)

    def test_variables_beside_a_structure_of_their_section(self):
        text = self.text_of({"Q": numpy.eye(2), "lqr": {"horizon": 5.0}, "R": 1.0})
        self.assertIn("[lqr]\nhorizon = 5\nQ = [[1, 0],\n     [0, 1]]\nR = [1]\n", text)

    def test_stages(self):
        stage = numpy.zeros((1, 2), dtype=[("from", object), ("R", object)])
        stage[0, 0], stage[0, 1] = (20.0, 2.0), (60.0, 3.0)
        text = self.text_of({"stage": stage})
        self.assertIn("[[stage]]\nfrom = 20\nR = [2]\n\n[[stage]]\nfrom = 60\nR = [3]\n", text)
        self.assertEqual(self.text_of({"stage": stage[:, :1]}).count("[[stage]]"), 1)

    def test_matrices_in_a_structure(self):
        for keys in ({"motor": {**PLANT, "Q": numpy.eye(2)}}, {"motor": {**PLANT, "Q": numpy.eye(2)}, "other": 1.0}):
            save("structure.mat", **keys)
            self.assertIn("lqr", tinylqg.read_mat("structure.mat", "motor"))
        with self.refused("structure.mat", "a structure engine", "motor, other"):
            tinylqg.read_mat("structure.mat", "engine")
        save("structure.mat", motor=PLANT)
        self.assertIn("plant", tinylqg.read_mat("structure.mat"))

    def test_empty_matrix_is_none(self):
        self.assertNotIn("D =", self.text_of({"D": numpy.zeros((0, 0))}))
        self.assertNotIn("C =", self.text_of({"C": numpy.zeros((0, 2)), "D": numpy.zeros((0, 1))}))
        with self.refused("plant.mat", "expected the matrix A"):
            self.text_of({"A": numpy.zeros((0, 0))})

    def test_Ts_is_what_MATLAB_means_by_it(self):
        self.assertIn('domain = "continuous"\nsample_time = 0.1\n', self.text_of({}))
        self.assertIn('domain = "discrete"\nsample_time = 0.25\n', self.text_of({"Ts": 0.25}, sample_time=None))
        with self.refused("Ts = 0", "-1"):
            self.text_of({"Ts": -1.0})
        with self.refused("plant.sample_time", "0.25", "0.1"):
            self.text_of({"Ts": 0.25})
        with self.refused("domain", "discrete", "continuous"):
            self.text_of({"Ts": 0.25, "domain": "continuous"})

    def test_integers_and_logicals_are_numbers(self):
        text = self.text_of(
            {"A": numpy.array([[0, 1], [0, -2]], dtype=numpy.int8), "lqr": {"structure": numpy.array([[True, False]])}}
        )
        self.assertIn("A = [[0, 1],\n     [0, -2]]\n", text)
        self.assertIn("structure = [[1, 0]]\n", text)

    def test_sparse_matrices_are_written_out(self):
        import scipy.sparse

        self.assertIn("A = [[0, 1],\n     [0, -2]]\n", self.text_of({"A": scipy.sparse.csc_matrix(PLANT["A"])}))

    def test_what_is_wrong_is_said(self):
        with self.refused("plant.mat", "expected the variables A, B", "found Kp, z"):
            self.text_of({"Kp": 1.0, "z": 2.0})
        with self.refused("lqr.Q: given twice", "structure lqr"):
            self.text_of({"Q": numpy.eye(2), "lqr": {"Q": numpy.eye(2)}})
        save("empty.mat")
        with self.refused("empty.mat", "expected the matrix A"):
            tinylqg.read_mat("empty.mat")
        with self.refused("delay", "a number", "1 × 2"):
            self.text_of({"delay": [[1.0, 2.0]]})
        with self.refused("kalman: expected a structure"):
            self.text_of({"kalman": 1.0})
        Path("text.mat").write_text("A = [[1]]")
        with self.refused("text.mat", "a .mat file"):
            tinylqg.read_mat("text.mat")
        with self.assertRaises(FileNotFoundError):
            tinylqg.read_mat("missing.mat")


if __name__ == "__main__":
    unittest.main()
