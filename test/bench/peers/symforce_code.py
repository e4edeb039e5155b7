# SPDX-License-Identifier: MIT
"""symforce_code.py NAME.json constant|carried FOLDER: SymForce's C++ of the model, as flight software has it: a
function for the correction by each output alone, whose variance is a scalar, and one for law and prediction. Zeros and
ones of the model fold away; all other numbers are arguments, which the compiler knows (symforce.cpp). As numbers in the
expressions they would multiply out A P Aᵀ entry by entry."""

import json
import sys
from pathlib import Path

import symforce

symforce.set_epsilon_to_number()  # before the rest of it is imported

import symforce.symbolic as sf
from symforce import codegen
from symforce.values import Values


class Numbers:
    """The matrices of the model, as symbols where they are not 0, 1 or −1."""

    def __init__(self):
        self.values = []

    def matrix(self, entries):
        return sf.Matrix([[self.entry(entry) for entry in row] for row in entries])

    def entry(self, value):
        if value in (0, 1, -1):
            return sf.S(int(value))
        self.values.append(value)
        return sf.Symbol(f"a{len(self.values) - 1}")

    def argument(self):
        return sf.Matrix([[sf.Symbol(f"a{i}")] for i in range(len(self.values))])


def symbols(name, count):
    return sf.Matrix([[sf.Symbol(f"{name}{i}")] for i in range(count)])


def symmetric(lower, size):
    def entry(i, j):
        return lower[i * (i + 1) // 2 + j] if i >= j else entry(j, i)

    return sf.Matrix([[entry(i, j) for j in range(size)] for i in range(size)])


def lower_triangle(P):
    return sf.Matrix([[P[i, j]] for i in range(P.shape[0]) for j in range(i + 1)])


def write(name, inputs, outputs, folder):
    function = codegen.Codegen(Values(**inputs), Values(**outputs), config=codegen.CppConfig(), name=name)
    function.generate_function(output_dir=folder, skip_directory_nesting=True)


def main():
    design = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    carried, folder = sys.argv[2] == "carried", Path(sys.argv[3])
    plant, noise = design["plant"], design["noise"]
    numbers = Numbers()
    A, B, C = (numbers.matrix(plant[key]) for key in "ABC")
    K = numbers.matrix(design["lqr"]["K"])
    nx, ny = len(plant["A"]), len(plant["C"])
    x, y = symbols("x", nx), symbols("y", ny)
    if carried:
        V = [numbers.entry(noise["V"][i][i]) for i in range(ny)]
        G = plant.get("G", [[float(i == j) for j in range(nx)] for i in range(nx)])
        sources = range(len(noise["W"]))
        W = [
            [sum(G[i][k] * noise["W"][k][m] * G[j][m] for k in sources for m in sources) for j in range(nx)]
            for i in range(nx)
        ]
        W = numbers.matrix([[W[i][j] if i >= j else 0 for j in range(nx)] for i in range(nx)])
        P = symmetric(symbols("P", nx * (nx + 1) // 2), nx)
    else:
        L = numbers.matrix(design["kalman"]["L"])
    state = {"x": x} | ({"P": symbols("P", nx * (nx + 1) // 2)} if carried else {})
    given = state | {"a": numbers.argument()}

    if carried:
        for i in range(ny):
            Pc = P * C[i, :].T
            s = (C[i, :] * Pc)[0] + V[i]
            gain = Pc / s
            innovation = sf.Symbol("y") - (C[i, :] * x)[0]
            write(
                f"update_{i}",
                given | {"y": sf.Symbol("y")},
                {"x_new": x + gain * innovation, "P_new": lower_triangle(P - gain * Pc.T)},
                folder,
            )
        u = -K * x
        predicted = A * P * A.T
        P_new = sf.Matrix([[predicted[i, j] + W[i, j]] for i in range(nx) for j in range(i + 1)])
        write("predict", given, {"u": u, "x_new": A * x + B * u, "P_new": P_new}, folder)
    else:
        corrected = x + L * (y - C * x)
        u = -K * corrected
        write("update", given | {"y": y}, {"x_new": corrected}, folder)
        write("predict", given, {"u": -K * x, "x_new": A * x + B * (-K * x)}, folder)
    entries = ", ".join(
        f"{value:.9g}f" if "." in f"{value:.9g}" or "e" in f"{value:.9g}" else f"{value:.9g}.0f"
        for value in numbers.values
    )
    updates = "".join(f'#include "update_{i}.h"\n' for i in range(ny)) if carried else '#include "update.h"\n'
    calls = "".join(f"CORRECT({i})\n" for i in range(ny)) if carried else ""
    (folder / "model_code.h").write_text(
        f'{updates}#include "predict.h"\nstatic const float entries[] = {{{entries}}};\n', encoding="utf-8"
    )
    (folder / "corrections.h").write_text(calls, encoding="utf-8")


main()
