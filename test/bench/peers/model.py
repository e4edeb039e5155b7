# SPDX-License-Identifier: MIT
"""model.py NAME.json constant|carried > MODEL: the numbers of an emitted controller for the other contestants, noises
for its loop, and the last u by a filter in double."""

import json
import random
import sys

SAMPLES = 301


def product(*factors):
    out = factors[0]
    for factor in factors[1:]:
        out = [[sum(a * b for a, b in zip(row, column)) for column in zip(*factor)] for row in out]
    return out


def transposed(matrix):
    return [list(column) for column in zip(*matrix)]


def combined(a, b, sign=1):
    return [[p + sign * q for p, q in zip(*rows)] for rows in zip(a, b)]


def inverse(matrix):
    """By Gauss and Jordan: S is positive definite."""
    size = len(matrix)
    rows = [list(row) + [float(i == j) for j in range(size)] for i, row in enumerate(matrix)]
    for i in range(size):
        rows[i] = [entry / rows[i][i] for entry in rows[i]]
        for k in range(size):
            if k != i:
                rows[k] = [a - rows[k][i] * b for a, b in zip(rows[k], rows[i])]
    return [row[size:] for row in rows]


def run(model, carried):
    """Noises of the size that the filter expects, one row a sample, and u in the last sample of the loop with them. The
    plant is the model itself."""
    A, B, C, K, V, W = (model[key] for key in "ABCKVW")
    random_numbers = random.Random(1)
    w = [[random_numbers.gauss(0, W[i][i] ** 0.5) for i in range(len(A))] for _ in range(SAMPLES)]
    v = [[random_numbers.gauss(0, V[i][i] ** 0.5) for i in range(len(C))] for _ in range(SAMPLES)]
    x = true = [[0.0] for _ in A]
    P = model["P0"]
    for k in range(SAMPLES):
        y = combined(product(C, true), transposed([v[k]]))
        gain = model["L"]
        if carried:
            PC = product(P, transposed(C))
            gain = product(PC, inverse(combined(product(C, PC), V)))
            P = combined(P, product(gain, transposed(PC)), -1)
        x = combined(x, product(gain, combined(y, product(C, x), -1)))
        u = [[-row[0]] for row in product(K, x)]
        x = combined(product(A, x), product(B, u))
        P = combined(product(A, P, transposed(A)), W)
        P = [[(a + b) / 2 for a, b in zip(*rows)] for rows in zip(P, transposed(P))]
        true = combined(combined(product(A, true), product(B, u)), transposed([w[k]]))
    return w, v, u


def array(name, matrix):
    entries = ", ".join(
        f"{entry!r}f" if "e" in repr(entry) or "." in repr(entry) else f"{entry}.0f" for row in matrix for entry in row
    )
    return f"static const float {name}[] = {{{entries}}};"


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        design = json.load(file)
    missing = [key for key in ("plant", "noise", "kalman", "lqr") if key not in design]
    if missing:
        sys.exit(
            f"{sys.argv[1]}: expected a filter with its noise and a regulator, found no {' and no '.join(missing)}"
        )
    plant, noise, kalman = design["plant"], design["noise"], design["kalman"]
    model = {key: plant[key] for key in "ABC"} | {"K": design["lqr"]["K"], "V": noise["V"]}
    G = plant.get("G", [[float(i == j) for j in range(len(plant["A"]))] for i in range(len(plant["A"]))])
    model["W"] = product(G, noise["W"], transposed(G))
    model["L"] = kalman.get("L", [[0.0] * len(plant["C"])] * len(plant["A"]))
    model["P0"] = kalman.get("P0", model["W"])
    if any(any(row) for row in plant.get("D", [])) or len(model["K"][0]) != len(plant["A"]):
        sys.exit(f"{sys.argv[1]}: expected no D and a law of x alone, found another")
    carried = sys.argv[2] == "carried"
    w, v, u = run(model, carried)
    print(f"enum {{ NX = {len(plant['A'])}, NU = {len(plant['B'][0])}, NY = {len(plant['C'])} }};")
    for name in "ABCK" + ("VW" if carried else "L"):
        print(array(name, model[name]))
    if carried:
        print(array("P0", model["P0"]))
    print("#ifdef WITH_SAMPLES")
    for name, rows, columns in (("w_in", w, "NX"), ("v_in", v, "NY")):
        lines = ",\n    ".join("{" + ", ".join(f"{entry:.9e}f" for entry in row) + "}" for row in rows)
        print(f"static const float {name}[][{columns}] = {{\n    {lines}}};")
    print(array("u_end", u))
    print("#endif")


main()
