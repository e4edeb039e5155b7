# SPDX-License-Identifier: MIT
"""A controller in closed loop with its plant: runs lqgen, writes what closed_loop.h has to know, compiles a program.

Everything is written below the current folder. CC is the compiler.
"""

import json
import math
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CC = shlex.split(os.environ.get("CC", "cc"))
ASSUMED_VARIANCE = 1e-4  # beside an observer, whose design says nothing of noise
UNSTABLE = 1 + 1e-6


def stop(why: str) -> None:
    print(why, file=sys.stderr)
    sys.exit(2)


def run(*command) -> subprocess.CompletedProcess:
    parts = [str(part) for part in command]
    return subprocess.run(parts, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, text=True)


def product(a, b):
    columns = list(zip(*b))
    return [[sum(x * y for x, y in zip(row, column)) for column in columns] for row in a]


def transposed(a):
    return [list(row) for row in zip(*a)]


def square_root(s):
    """F Fᵀ = S, F lower triangular, S positive semidefinite."""
    size = len(s)
    f = [[0.0] * size for _ in range(size)]
    for j in range(size):
        left = s[j][j] - sum(f[j][k] ** 2 for k in range(j))
        if left <= 1e-12 * s[j][j]:
            continue
        f[j][j] = math.sqrt(left)
        for i in range(j + 1, size):
            f[i][j] = (s[i][j] - sum(f[i][k] * f[j][k] for k in range(j))) / f[j][j]
    return f


def noise_factor(design, plant):
    """Of G w and v together."""
    nx, ny = len(plant["A"]), len(plant["C"])
    noise = design.get("noise")
    if not noise:
        return square_root([[ASSUMED_VARIANCE * (i == j) for j in range(nx + ny)] for i in range(nx + ny)])
    state = product(product(plant["G"], noise["W"]), transposed(plant["G"]))
    cross = product(plant["G"], noise["cross"]) if noise["cross"] else [[0.0] * ny for _ in range(nx)]
    above = [row + beside for row, beside in zip(state, cross)]
    return square_root(above + [row + beside for row, beside in zip(transposed(cross), noise["V"])])


def eigenvalues(a):
    """Roots of the characteristic polynomial (Faddeev and LeVerrier) by Durand and Kerner: good enough for those that
    unstable_modes confirms."""
    size = len(a)
    identity = [[float(i == j) for j in range(size)] for i in range(size)]
    coefficients, m = [1.0], identity
    for k in range(1, size + 1):
        am = product(a, m)
        coefficients.append(-sum(am[i][i] for i in range(size)) / k)
        m = [[x + coefficients[-1] * y for x, y in zip(row, unit)] for row, unit in zip(am, identity)]
    roots = [(0.4 + 0.9j) ** i for i in range(size)]
    for _ in range(500):
        for i, root in enumerate(roots):
            value, others = 0, 1
            for coefficient in coefficients:
                value = value * root + coefficient
            for j, other in enumerate(roots):
                others *= root - other if j != i else 1
            roots[i] -= value / (others or 1e-30)
    return roots


def solved(a, b):
    """a x = b by elimination with the largest pivot of each column."""
    rows = [list(row) + [value] for row, value in zip(a, b)]
    for k in range(len(rows)):
        best = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        pivot = rows[k][k] or 1e-300
        for i, row in enumerate(rows):
            if i != k:
                rows[i] = [x - row[k] / pivot * y for x, y in zip(row, rows[k])]
    return [row[-1] / (row[k] or 1e-300) for k, row in enumerate(rows)]


def unstable_modes(a):
    """(w, |λ|) of each wᵀA = λ wᵀ that grows, w by inverse iteration; what is not confirmed is left out."""
    at, found = transposed(a), []
    for root in eigenvalues(a):
        if abs(root) < UNSTABLE:
            continue
        shifted = [[x - (root + 1e-10) * (i == j) for j, x in enumerate(row)] for i, row in enumerate(at)]
        w = [1.0 + 0.1j * i for i in range(len(a))]
        for _ in range(3):
            w = solved(shifted, w)
            largest = max(abs(x) for x in w)
            w = [x / largest for x in w]
        residual = max(abs(sum(x * y for x, y in zip(row, w)) - root * w[i]) for i, row in enumerate(at))
        if residual < 1e-8:
            found.append((w, abs(root)))
    return found


def members(header: str):
    """Name and type of each number of the state, the counters among them."""
    body = re.search(r"typedef struct \{\n(.*?)\n\} \w+_t;", header, re.S).group(1)
    found = re.findall(r"^    (float|double|unsigned long|unsigned) (\w+)(?:\[|;)", body, re.M)
    return [(name, kind) for kind, name in found]


def array(name, rows, kind="double"):
    values = [value for row in rows for value in row] or [0.0]
    return f"static const {kind} {name}[] = {{{', '.join(repr(float(value)) for value in values)}}};\n"


def table(name: str, numbers) -> str:
    """Where these numbers of the controller's state are, of which members() has names and types."""
    rows = "".join(
        f'    {{"{member}", offsetof(OF(t), {member}), sizeof(((OF(t) *)0)->{member}), sizeof({kind}), '
        f'{int(kind in ("float", "double"))}}},\n'
        for member, kind in numbers
    )
    return f"static const struct member {name}[] = {{\n{rows}}};\n"


def plant_of(design):
    return design["stages"][-1]["plant"] if "stages" in design else design["plant"]


def plant_text(design, limits: dict, header: str) -> str:
    """What closed_loop.h has to know beside the header."""
    name = design["name"]
    plant = plant_of(design)
    nx, ny, nu = len(plant["A"]), len(plant["C"]), len(plant["B"][0]) if plant["B"] else 0
    text = f'#include "{name}.h"\n#define OF(part) {name}_##part\ntypedef {design["code"]["real"]} real;\n'
    text += f"enum {{ NX = {nx}, NU = {nu}, NY = {ny} }};\n"
    for matrix in "ABCD":
        text += array(matrix, plant[matrix])
    text += array("factor", noise_factor(design, plant))
    point = design.get("operating_point", {})
    text += array("y_point", [point.get("outputs", [0.0] * ny)]) + array("u_point", [point.get("inputs", [0.0] * nu)])
    for which, infinite in (("u_min", -math.inf), ("u_max", math.inf)):
        text += array(which, [limits.get(which, [infinite] * nu)]).replace("inf", "(double)INFINITY")
    modes = unstable_modes(plant["A"]) if f"{name}_control(" in header else []
    text += f"enum {{ MODES = {len(modes)} }};\n"
    text += array("mode_re", [[x.real for x in w] for w, _ in modes])
    text += array("mode_im", [[x.imag for x in w] for w, _ in modes])
    text += array("mode_size", [[size for _, size in modes]])
    if "compensator" in design:
        text += "#define KEEPS_Z\n"
    if "modes" in design:
        text += "#define KEEPS_MODES\n"
    if f"{name}_control(" in header:
        text += "#define HAS_REGULATOR\n"
    if nu:
        text += "#define HAS_INPUT\n"
    if design["kalman"]["form"] == "predictor":
        text += "#define IS_PREDICTOR\n"
    return text


def generate(build: Path, file: Path, style: str, *options):
    """The design as lqgen's JSON has it; None, and what lqgen said is printed, where it refuses the file."""
    lqgen = build / "codegen" / "lqgen"
    if not lqgen.exists():
        stop(f"Not found: {lqgen}")
    for old in Path().glob("*.json"):
        old.unlink()
    done = run(lqgen, file, "-o", ".", "--only", "h,json", "--quiet", "--style", style, *options)
    if done.returncode:
        print(done.stdout, end="")
        return None
    return json.loads(next(Path().glob("*.json")).read_text())


def build_program(design, text: str, program: str, folder=Path(__file__).parent) -> None:
    """Of the folder's program.c, which includes closed_loop.h."""
    Path("plant.h").write_text(text)
    code = design["code"]
    options, sources = ["-std=c99", "-O2", "-I", ".", "-I", ROOT / "include"], [ROOT / "src" / "status.c"]
    options += ["-I", Path(__file__).parent]
    if code["style"] == "compact" or "limits" in design:
        options += ["-DLQG_REAL_DOUBLE"] * (code["real"] == "double")
        options += ["-DLQG_FUSED"] * (code["arithmetic"] == "fused")
        sources = sorted((ROOT / "src").glob("*.c"))
    built = run(*CC, *options, folder / f"{program}.c", *sources, "-lm", "-o", program)
    if built.returncode:
        stop(built.stdout)
