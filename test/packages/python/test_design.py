# SPDX-License-Identifier: MIT
"""A design in memory: what it is made of, what it gives, and how it refuses."""

import copy
import pickle
import tomllib
import unittest
from pathlib import Path

import control
import numpy
import scipy.linalg

import tinylqg
from designs import DESIGNS, SOURCE, InFolder

SERVO = SOURCE / "codegen" / "designs" / "servo.toml"
MASS = {
    "A": [[1, 0.01], [0, 1]],
    "B": [[5e-5], [0.01]],
    "C": [[1, 0]],
    "domain": "discrete",
    "sample_time": 0.01,
    "Q": [1, 1],
    "R": 1,
    "W": numpy.diag([1e-4, 1e-2]),
    "V": [1e-3],
}


class Numbers(InFolder):
    def test_gains_are_those_of_the_riccati_equations(self):
        design = tinylqg.Design(**MASS)
        A, B, C = (numpy.array(MASS[key]) for key in "ABC")
        X = scipy.linalg.solve_discrete_are(A, B, numpy.eye(2), numpy.eye(1))
        P = scipy.linalg.solve_discrete_are(A.T, C.T, MASS["W"], numpy.array([[1e-3]]))
        numpy.testing.assert_allclose(design.K, numpy.linalg.solve(1 + B.T @ X @ B, B.T @ X @ A), rtol=1e-9)
        numpy.testing.assert_allclose(design.L, P @ C.T / (C @ P @ C.T + 1e-3), rtol=1e-9)
        closed = numpy.linalg.eigvals(A - B @ design.K)
        self.assertLess(abs(numpy.poly(closed) - numpy.poly(design.solve().lqr.poles)).max(), 1e-9)
        self.assertTrue((abs(design.poles) < 1).all())

    def test_a_file_and_its_design_give_the_same(self):
        for file in DESIGNS:
            made = tinylqg.generate(file)
            design = tinylqg.Design.load(file)
            self.assertEqual(made.loop.poles.tobytes(), design.poles.tobytes(), file.name)
        self.assertEqual(tinylqg.Design.load(SERVO).text, SERVO.read_text(encoding="utf-8"))

    def test_systems_of_python_control_and_arrays_give_the_same_text(self):
        plant = control.ss([[0, 1], [0, -2]], [[0], [3]], [[1, 0]], 0)
        arrays = {"A": [[0, 1], [0, -2]], "B": [[0], [3]], "C": [[1, 0]], "D": 0, "domain": "continuous"}
        self.assertEqual(
            tinylqg.Design(plant, sample_time=0.1, Q=[1, 1], R=1),
            tinylqg.Design(**arrays, sample_time=0.1, Q=[1, 1], R=1),
        )

    def test_margins_rms_and_findings_are_those_of_the_result(self):
        design = tinylqg.Design.load(SERVO)
        self.assertEqual(design.margins.phase_margin_deg, design.solve().loop.phase_margin_deg)
        self.assertIn("delay_margin_s", design.margins)
        self.assertNotIn("poles", design.margins)
        self.assertEqual(list(design.rms), ["x", "u", "y"])
        (finding,) = design.findings
        self.assertEqual(finding.key, "limits.u_max[0]")
        self.assertRegex(finding.place, r"servo\.toml:\d+:\d+$")
        self.assertIs(design.solve(), design.solve())

    def test_other_tools_get_what_the_result_gives(self):
        design = tinylqg.Design(**MASS)
        for part in ("plant", "controller"):
            numpy.testing.assert_array_equal(design.to_control(part).A, design.solve().to_control(part).A)
            numpy.testing.assert_array_equal(design.to_scipy(part).A, design.solve().to_scipy(part).A)


class Values(InFolder):
    def test_a_design_is_its_text(self):
        design = tinylqg.Design.load(SERVO)
        design.solve()
        for other in (pickle.loads(pickle.dumps(design)), copy.copy(design), copy.deepcopy(design)):
            self.assertEqual(other, design)
            self.assertEqual(hash(other), hash(design))
            numpy.testing.assert_array_equal(other.K, design.K)
        self.assertNotIn(b"solution", pickle.dumps(design))
        self.assertNotEqual(design, design.replace(rho=2))
        self.assertIn("servo: 2 states, 1 outputs, T = 0.001 s", repr(design))

    def test_a_design_does_not_change(self):
        design = tinylqg.Design(**MASS)
        with self.assertRaisesRegex(AttributeError, "replace"):
            design.Q = [1, 1]
        other = design.replace(Q=[2, 1])
        self.assertEqual((design.tables["lqr"]["Q"], other.tables["lqr"]["Q"]), ([1, 1], [2, 1]))

    def test_replaced_values_are_where_they_belong(self):
        servo = tinylqg.Design.load(SERVO)
        for values, section, key, value in (
            ({"rho": 3}, "lqr", "bryson", {"states": [0.05, 30], "inputs": [12], "rho": 3}),
            ({"lqr.bryson.states[1]": 40.0}, "lqr", "bryson", {"states": [0.05, 40], "inputs": [12]}),
            ({"V": numpy.array([1e-6])}, "kalman", "measurement_noise", [1e-6]),
            ({"u_max": [6]}, "limits", "u_max", [6]),
            ({"delay": 0.001}, "plant", "delay", 0.001),
            ({"A[1][1]": -40}, "plant", "A", [[0, 1], [0, -40]]),
            ({"kalman.form": "predictor"}, "kalman", "form", "predictor"),
        ):
            self.assertEqual(servo.replace(values).tables[section][key], value)
        self.assertNotIn("delay", servo.replace(delay=1).replace(delay=None).tables["plant"])
        mass = tinylqg.Design(**MASS)
        self.assertEqual(mass.replace(rho=0.5).tables["lqr"]["R"], [[0.5]])
        self.assertEqual(mass.replace({"name": "other"}).name, "other")

    def test_parameters_and_expressions_are_those_of_the_file(self):
        motor = {
            "parameters": {"R": {"value": 2, "unit": "ohm"}, "Kt": 0.5, "J": 0.25, "T": "1/100"},
            "A": [[0, 1], [0, "-Kt^2/(R*J)"]],
            "B": [[0], ["Kt/(R*J)"]],
            "domain": "continuous",
            "sample_time": "T",
            "Q": [1, 1],
            "R": "R/2",
            "limits": {"u_max": ["6*R"], "u_min": [-12]},
        }
        design = tinylqg.Design(**motor)
        numbers = dict(motor, A=[[0, 1], [0, -0.5]], B=[[0], [1]], sample_time=0.01, R=1)
        numbers["limits"] = {"u_max": [12], "u_min": [-12]}
        numpy.testing.assert_array_equal(design.K, tinylqg.Design(**numbers).K)
        result = design.solve()
        self.assertEqual(result.parameters["R"], {"value": 2, "unit": "ohm"})
        self.assertEqual(result.expressions["plant.A[1][1]"], {"value": -0.5, "expression": "-Kt^2/(R*J)"})
        stronger = design.replace({"parameters.R": 4})
        self.assertEqual(stronger.tables["parameters"]["R"], {"value": 4, "unit": "ohm"})
        self.assertEqual(stronger.solve().expressions["plant.A[1][1]"].value, -0.25)
        self.assertEqual(design.replace(rho=3).solve().expressions["lqr.R[0][0]"].value, 3)
        design.plot("response")
        with self.refused("plant.A", "Ktt", "did you mean `Kt`?"):
            design.replace(A=[[0, 1], [0, "Ktt"]]).solve()

    def test_every_design_of_the_tree_is_replaced_by_itself(self):
        for file in DESIGNS:
            design = tinylqg.Design.load(file)
            self.assertEqual(design.replace().tables, tomllib.loads(design.text), file.name)

    def test_written_files_are_those_of_the_design(self):
        design = tinylqg.Design(name="mass", **MASS)
        result = design.write("out")
        self.assertEqual(
            sorted(path.name for path in Path("out").iterdir()), ["mass.h", "mass.json", "mass.toml", "mass_test.c"]
        )
        self.assertEqual(Path("out/mass.toml").read_text(encoding="utf-8"), design.text)
        numpy.testing.assert_array_equal(result.K, design.K)
        other = design.replace(rho=2)
        with self.refused("out/mass.toml", "force=True"):
            other.write("out")
        other.write("out", force=True)
        self.assertEqual(tinylqg.Design.load("out/mass.toml"), other)


class Refusals(InFolder):
    def test_words_of_other_tools_are_explained(self):
        for word, meant in (
            ("QN", "W="),
            ("RN", "V="),
            ("dt", "sample_time="),
            ("Ts", "sample_time="),
            ("x0", "kalman={'initial_state'"),
            ("outptus", "outputs="),
            ("kalmann", "kalman="),
            ("u_max", "limits={'u_max'"),
            ("measurement_noise", "V="),
        ):
            with self.refused(f"{word}: unknown, did you mean {meant}"):
                tinylqg.Design(**MASS, **{word: 1})
        with self.refused("K is what lqgen computes"):
            tinylqg.Design(**MASS, K=[[1, 1]])
        with self.refused("wibble: unknown; known are", "sample_time"):
            tinylqg.Design(**MASS, wibble=1)
        with self.refused("kalman.QN: unknown key, did you mean"):
            tinylqg.Design(**MASS, kalman={"QN": 1}).solve()

    def test_sizes_and_numbers_are_refused_in_lqgens_words(self):
        for key, value, said in (
            ("B", [[1]], "plant.B: expected 2 rows (nx), found 1"),
            ("Q", [1, 2, 3], "lqr.Q: expected 2 numbers (nx), found 3"),
            ("V", [float("nan")], "kalman.measurement_noise[0]: expected a finite number, found nan"),
            ("A", [[1, float("inf")], [0, 1]], "plant.A[0][1]: expected a finite number, found inf"),
            ("R", -1, "lqr.R"),
        ):
            with self.refused(said):
                tinylqg.Design(**{**MASS, key: value}).solve()
        with self.assertRaises(tinylqg.DesignError) as caught:
            tinylqg.Design(**{**MASS, "B": [[1]], "Q": [1]}).solve()
        self.assertEqual(len(str(caught.exception).splitlines()), 2)
        self.assertNotIn("standard input", str(caught.exception))

    def test_a_files_errors_have_their_places(self):
        Path("bad.toml").write_text('name = "bad"\n[plant]\nsample_time = 1\nA = [[1, 2]]\n')
        with self.refused("bad.toml:4:5: plant.A"):
            tinylqg.Design.load("bad.toml").solve()
        Path("worse.toml").write_text("name = ")
        with self.refused("worse.toml", "a design file"):
            tinylqg.Design.load("worse.toml")
        with self.refused("name"):
            tinylqg.Design.from_text("[plant]\n")
        with self.assertRaises(FileNotFoundError):
            tinylqg.Design.load("missing.toml")

    def test_a_name_that_is_a_path_is_none(self):
        for name in ("../victim", "/tmp/victim", "a.b", ""):
            with self.refused("name", "lower-case letters"):
                tinylqg.Design.from_text(f'name = "{name}"\n[plant]\n')
            with self.refused("name", "lower-case letters"):
                tinylqg.Design(**MASS, name=name)
        with self.refused("design"):
            tinylqg.Design.from_text("a = " + "[" * 100000)

    def test_plants_that_are_none_or_two(self):
        with self.refused("plant", "A="):
            tinylqg.Design(Q=[1], R=1)
        with self.refused("plant.B: given twice"):
            tinylqg.Design(control.ss([[1]], [[1]], [[1]], 0, 1), B=[[1]])
        with self.refused("plant.domain"):
            tinylqg.Design(A=[[1]], B=[[1]], sample_time=1)

    def test_places_that_are_none(self):
        design = tinylqg.Design(**MASS)
        for values, said in (
            ({"lqr.QQ": 1}, "did you mean Q"),
            ({"lqg.Q": 1}, "did you mean lqr"),
            ({"lqr.Q[2]": 1}, "lqr.Q[2]: expected a number below 2"),
            ({"rhoo": 1}, "did you mean rho"),
            ({"lqr.Q[": 1}, "a place such as"),
            ({"lqr.N[0]": 1}, "has no N"),
            ({"form": "filter"}, "kalman.form or observer.form"),
        ):
            with self.refused(said):
                design.replace(values)


if __name__ == "__main__":
    unittest.main()
