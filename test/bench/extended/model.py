# SPDX-License-Identifier: MIT
"""model.py DESIGN.toml > model.h: the numbers of a model, what goes in, and x̂ and P that are expected to come out.
They are those of a filter in double that shares nothing with the contestants: Jacobians by SymPy, the step's by the
chain rule in NumPy, all outputs at once."""

import math
import random
import sys

import numpy
import sympy
from formulas import Formulas

SAMPLES = 301
# of the sample k
INPUTS = {
    "pendulum": lambda k: 1.5 * math.sin(0.025 * k),
    "cart_pole": lambda k: 5 * math.sin(0.06 * k) + 2 * math.sin(0.17 * k),
    "tracker": lambda k: 0.4 * math.sin(0.05 * k),
}
# of the plant; the filter begins at initial_state
STARTS = {"pendulum": [0.6, 0.5], "cart_pole": [0.005, 0.95, 0.2, -0.5], "tracker": [-11.5, 4.2, -0.4, 2.3]}


def function_and_jacobian(formulas, inputs):
    jacobian = sympy.Matrix(formulas).jacobian(inputs[0])
    return sympy.lambdify(inputs, (formulas, jacobian), "numpy")


class Plant:
    def __init__(self, formulas):
        x = sympy.symbols(f"x:{len(formulas.plant['states'])}")
        u = sympy.symbols(f"u:{len(formulas.plant['inputs'])}")
        self.period = formulas.period
        self.of_rates = function_and_jacobian(formulas.f(x, u), (x, u))
        self.of_outputs = function_and_jacobian(formulas.h(x), (x,))
        self.wraps = [formulas.wraps(i) for i in range(len(formulas.plant["h"]))]

    def rates(self, x, u):
        return tuple(numpy.array(part, dtype=float) for part in self.of_rates(x, u))

    def step(self, x, u):
        """The next x, and its Jacobian."""
        if not self.period:
            return self.rates(x, u)
        value, slopes, T = x, numpy.eye(len(x)), self.period
        sum_of_rates, sum_of_slopes = 0, 0
        for weight, ahead in ((1, T / 2), (2, T / 2), (2, T), (1, 0)):
            k, J = self.rates(value, u)
            D = J @ slopes
            sum_of_rates, sum_of_slopes = sum_of_rates + weight * k, sum_of_slopes + weight * D
            value, slopes = x + ahead * k, numpy.eye(len(x)) + ahead * D
        return x + T / 6 * sum_of_rates, numpy.eye(len(x)) + T / 6 * sum_of_slopes

    def outputs(self, x):
        return tuple(numpy.array(part, dtype=float) for part in self.of_outputs(x))

    def wrapped(self, difference):
        return numpy.array([math.remainder(d, 2 * math.pi) if wraps else d for d, wraps in zip(difference, self.wraps)])


def run(plant, name, W, V, x, P):
    """Inputs and outputs, and x̂ and P behind each sample."""
    random_numbers = random.Random(1)
    true = numpy.array(STARTS[name])
    u_in, y_in, x_out, P_out = [], [], [], []
    for k in range(SAMPLES):
        u = numpy.array([INPUTS[name](k)])
        noise = [random_numbers.gauss(0, v**0.5) for v in V]
        y = plant.wrapped(plant.outputs(true)[0] + noise)
        h, H = plant.outputs(x)
        gain = P @ H.T @ numpy.linalg.inv(H @ P @ H.T + numpy.diag(V))
        x = x + gain @ plant.wrapped(y - h)
        P = P - gain @ H @ P
        x, A = plant.step(x, u)
        P = A @ P @ A.T + numpy.diag(W)
        P = (P + P.T) / 2
        true = plant.step(true, u)[0] + [random_numbers.gauss(0, w**0.5) for w in W]
        for series, value in zip((u_in, y_in, x_out, P_out), (u, y, x, P.ravel())):
            series.append(value)
    return u_in, y_in, x_out, P_out


def array(name, numbers):
    return f"static const real_t {name}[] = {{{', '.join(repr(float(number)) for number in numbers)}}};"


def table(name, rows):
    lines = ",\n    ".join("{" + ", ".join(f"{number:.17g}" for number in row) + "}" for row in rows)
    return f"static const real_t {name}[][{len(rows[0])}] = {{\n    {lines}}};"


def main():
    formulas = Formulas(sys.argv[1], vars(sympy))
    W, V = (formulas.filter[key] for key in ("process_noise", "measurement_noise"))
    x, P = formulas.filter["initial_state"], formulas.filter["initial_covariance"]
    series = run(Plant(formulas), formulas.name, W, V, numpy.array(x, dtype=float), numpy.diag(P))
    print(f"enum {{ NX = {len(x)}, NU = {len(formulas.plant['inputs'])}, NY = {len(V)}, SAMPLES = {SAMPLES} }};")
    print(f"#define IS_CONTINUOUS {int(formulas.period > 0)}")
    print("#define WRAPS {" + ", ".join(str(int(formulas.wraps(i))) for i in range(len(V))) + "}")
    print(f"static const real_t T = {formulas.plant['sample_time']!r};")
    for name, numbers in zip(("W", "V", "X0", "P0"), (W, V, x, P)):
        print(array(name, numbers))
    print("#ifdef WITH_SAMPLES")
    for name, rows in zip(("u_in", "y_in", "x_expected", "P_expected"), series):
        print(table(name, rows))
    print("#endif")


main()
