# SPDX-License-Identifier: MIT
"""symforce_code.py DESIGN.toml FOLDER: SymForce's C++ of the model, a function for all outputs of a sample, one after
the other, and one for the prediction. Zeros and ones fold away; parameters, the period and the variances are arguments,
which the compiler knows (symforce.cpp). The Jacobian of the Runge-Kutta step is made twice: of the step as a whole
(predict_whole), and by the chain rule, stage by stage (predict_staged)."""

import sys
from pathlib import Path

import symforce

symforce.set_epsilon_to_number()  # before the rest of it is imported

import symforce.symbolic as sf
from formulas import Formulas
from symforce import codegen
from symforce.values import Values


def vector(name, count):
    return sf.Matrix([[sf.Symbol(f"{name}{i}")] for i in range(count)])


def symmetric(lower, size):
    def entry(i, j):
        return lower[i * (i + 1) // 2 + j] if i >= j else entry(j, i)

    return sf.Matrix([[entry(i, j) for j in range(size)] for i in range(size)])


def lower_triangle(P):
    return sf.Matrix([[P[i, j]] for i in range(P.shape[0]) for j in range(i + 1)])


class Model:
    def __init__(self, path):
        names = list(Formulas(path, {}).numbers)
        self.constants = vector("a", len(names) + 1)
        # without epsilon, SymForce's guard where atan2 has no slopes: the answers would differ
        library = {"sin": sf.sin, "cos": sf.cos, "sqrt": sf.sqrt, "atan2": lambda y, x: sf.atan2(y, x, epsilon=0)}
        self.formulas = Formulas(path, library, dict(zip(names, self.constants)))
        self.numbers = [*self.formulas.numbers.values(), self.formulas.plant["sample_time"]]
        self.nx, self.nu = len(self.formulas.plant["states"]), len(self.formulas.plant["inputs"])
        self.x, self.u = vector("x", self.nx), vector("u", self.nu)
        self.P_lower = vector("P", self.nx * (self.nx + 1) // 2)
        self.P = symmetric(self.P_lower, self.nx)
        self.W, self.V = vector("W", self.nx), vector("V", len(self.formulas.plant["h"]))

    def rates(self, x):
        return sf.Matrix([[value] for value in self.formulas.f(x, self.u)])

    def step(self):
        if not self.formulas.period:
            return self.rates(self.x)
        T = self.constants[-1]
        k1 = self.rates(self.x)
        k2 = self.rates(self.x + T / 2 * k1)
        k3 = self.rates(self.x + T / 2 * k2)
        k4 = self.rates(self.x + T * k3)
        return self.x + T / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

    def jacobian_by_stages(self):
        if not self.formulas.period:
            return self.rates(self.x).jacobian(self.x)
        T, unit = self.constants[-1], sf.Matrix.eye(self.nx, self.nx)
        rates, slopes = self.rates(self.x), self.rates(self.x).jacobian(self.x)
        value, D, total = self.x, unit, sf.Matrix.zeros(self.nx, self.nx)
        for weight, ahead in ((1, T / 2), (2, T / 2), (2, T), (1, 0)):
            at = {self.x[i]: value[i] for i in range(self.nx)}
            J = slopes.subs(at) * D
            total = total + weight * J
            value, D = self.x + ahead * rates.subs(at), unit + ahead * J
        return unit + T / 6 * total

    def update(self):
        x, P = self.x, self.P
        expected = self.formulas.h(self.x)
        C = sf.Matrix([[value] for value in expected]).jacobian(self.x)
        y = vector("y", len(expected))
        for i, value in enumerate(expected):
            difference = y[i] - value
            if self.formulas.wraps(i):
                difference = sf.wrap_angle(difference)
            PC = P * C[i, :].T
            gain = PC / ((C[i, :] * PC)[0] + self.V[i])
            x, P = x + gain * (difference - (C[i, :] * (x - self.x))[0]), P - gain * PC.T
        return {"x": self.x, "P": self.P_lower, "a": self.constants, "V": self.V, "y": y}, x, P

    def predict(self, A):
        given = {"x": self.x, "P": self.P_lower, "u": self.u, "a": self.constants, "W": self.W}
        return given, self.step(), A * self.P * A.T + sf.Matrix.diag(list(self.W))


def write(name, folder, given, x, P):
    out = {"x_new": x, "P_new": lower_triangle(P)}
    function = codegen.Codegen(Values(**given), Values(**out), config=codegen.CppConfig(), name=name)
    function.generate_function(output_dir=folder, skip_directory_nesting=True)


def main():
    model, folder = Model(sys.argv[1]), Path(sys.argv[2])
    write("update", folder, *model.update())
    write("predict_whole", folder, *model.predict(model.step().jacobian(model.x)))
    write("predict_staged", folder, *model.predict(model.jacobian_by_stages()))
    numbers = ", ".join(repr(float(number)) for number in model.numbers)
    (folder / "constants.h").write_text(f"static const real_t constants[] = {{{numbers}}};\n", encoding="utf-8")


main()
