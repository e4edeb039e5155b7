# SPDX-License-Identifier: MIT
"""Writes linearisation_reference.hpp: plants of equations, their operating points and slopes, by mpmath.

    python3 linearisation_reference.py > linearisation_reference.hpp

Points by mpmath's secant and Newton methods, slopes by its differences, both with 200 digits: nothing here is
automatic differentiation or shared with lqgen. Python parses the formulas. Each number is the double nearest to its
text, as in a design file.
"""

import re

import mpmath as mp

mp.mp.dps = 200
DIFFERENCE = mp.mpf(10) ** -60  # central, with Richardson's extrapolation below

FUNCTIONS = {
    **{
        name: getattr(mp, name)
        for name in ["sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "tanh"]
    },
    "abs": abs,
    "min": min,
    "max": max,
    "pi": mp.pi,
    "M": lambda text: mp.mpf(float(text)),
}

# name, domain, states, inputs, f, h, values ("?" with where mpmath begins), states that are at rest (None: all)
PLANTS = [
    (
        "cart_pole_upright",
        "c",
        "p v th om",
        "F",
        [
            "v",
            "(F - 0.1*v + 0.2*sin(th)*(0.3*om^2 - 9.81*cos(th)))/(0.5 + 0.2*sin(th)^2)",
            "om",
            "(9.81*sin(th)*0.7 - cos(th)*(F - 0.1*v + 0.06*om^2*sin(th)))/(0.3*(0.5 + 0.2*sin(th)^2))",
        ],
        ["p", "th", "p + 0.3*sin(th)"],
        ["0", "0", "0", "0", "?0"],
        None,
    ),
    (
        "cart_pole_driving_at_an_angle",
        "c",
        "p v th om",
        "F",
        [
            "v",
            "(F - 0.1*v + 0.2*sin(th)*(0.3*om^2 - 9.81*cos(th)))/(0.5 + 0.2*sin(th)^2)",
            "om",
            "(9.81*sin(th)*0.7 - cos(th)*(F - 0.1*v + 0.06*om^2*sin(th)))/(0.3*(0.5 + 0.2*sin(th)^2))",
        ],
        ["p + 0.3*sin(th)", "om"],
        ["1.5", "0.75", "0.125", "0", "?1"],
        "th om",
    ),
    (
        "magnetic_levitation",
        "c",
        "z v i",
        "e",
        ["v", "9.81 - 2.4832e-5*(i/z)^2/0.02985", "(e - 1.42*i + 2*2.4832e-5*i*v/z^2)/(0.01 + 2*2.4832e-5/z)"],
        ["z", "i"],
        ["0.009", "0", "?0.5", "?1"],
        None,
    ),
    (
        "permanent_magnet_motor",
        "c",
        "id iq w",
        "ud uq load",
        [
            "(ud - 0.63*id + 3*w*0.0028*iq)/0.0028",
            "(uq - 0.63*iq - 3*w*(0.0028*id + 0.11))/0.0028",
            "(1.5*3*0.11*iq - 0.0005*w - 0.02*tanh(w/0.5) - load)/0.0012",
        ],
        ["id", "iq", "w"],
        ["0", "?1", "100", "?0", "?30", "0.25"],
        None,
    ),
    (
        "pendulum_with_friction",
        "c",
        "th om",
        "u",
        ["om", "(u - 0.004*om - 0.02*tanh(om/0.01) - 0.15*9.81*0.4*sin(th))/(0.15*0.4^2)"],
        ["atan2(sin(th), cos(th))", "exp(-om^2)*log(2 + th)/sqrt(1 + th^2)"],
        ["pi/6", "0", "?0.1"],
        None,
    ),
    (
        "sampled_tank",
        "d",
        "h1 h2",
        "q",
        ["h1 + 0.5*(q - 0.3*sqrt(h1))/2", "h2 + 0.5*(0.3*sqrt(h1) - 0.25*h2^0.55)/1.5"],
        ["h2"],
        ["?1", "0.8", "?0.2"],
        None,
    ),
    (
        "all_functions",
        "c",
        "a b",
        "u",
        ["u - max(a, b)*min(a, b)*abs(a - b) + tan(a)/3", "asin(a/2) + acos(b/4) - atan(a^-3) + b^1.5 - 0.1^u"],
        ["a*b^3/exp(a)"],
        ["0.25", "?1", "?0"],
        None,
    ),
]


def function(text, names):
    text = re.sub(r"(?<![A-Za-z_0-9.])(\d+\.?\d*(?:e-?\d+)?)", r"M('\1')", text).replace("^", "**")
    code = compile(text, text, "eval")
    return lambda point: eval(code, FUNCTIONS, dict(zip(names, point)))


def slope(f, point, j):
    def difference(h):
        moved = [list(point), list(point)]
        moved[0][j] += h
        moved[1][j] -= h
        return (f(moved[0]) - f(moved[1])) / (2 * h)

    return (4 * difference(DIFFERENCE) - difference(2 * DIFFERENCE)) / 3


def rounded(value):
    value = +value
    return "0.0" if abs(value) < mp.mpf(10) ** -90 else repr(float(mp.nstr(value, 60)))


def listed(texts):
    """In lines of at most 110 characters"""
    lines = [""]
    for text in texts:
        begins = not lines[-1]
        if not begins and len(lines[-1]) + len(text) > 100:
            lines[-1] += ","
            lines.append(text)
        else:
            lines[-1] += text if begins else ", " + text
    return "{" + "\n      ".join(lines) + "}"


def quoted(texts):
    return listed('"' + text + '"' for text in texts)


def solved(values, rates):
    point = [function(value, [])([]) if value[0] != "?" else mp.mpf(value[1:]) for value in values]
    open_ones = [j for j, value in enumerate(values) if value[0] == "?"]

    def full(found):
        out = list(point)
        for j, x in zip(open_ones, found):
            out[j] = x
        return out

    if not open_ones:
        return point
    residuals = [r for r in rates if any(abs(slope(r, point, j)) > 1e-40 for j in open_ones)]
    found = mp.findroot(
        [lambda *x, r=r: r(full(x)) for r in residuals],
        [point[j] for j in open_ones],
        tol=mp.mpf(10) ** -300,
        maxsteps=200,
    )
    found = [found] if isinstance(found, mp.mpf) else list(found)
    assert all(abs(rate(full(found))) < mp.mpf(10) ** -120 for rate in rates)
    return full(found)


def row(plant):
    name, domain, states, inputs, f, h, values, steady = plant
    x, u = states.split(), inputs.split()
    names = x + u
    fs, hs = [function(text, names) for text in f], [function(text, names) for text in h]
    at_rest = x if steady is None else steady.split()
    rates = [(lambda p, g=fs[i], i=i: g(p) - (p[i] if domain == "d" else 0)) for i in range(len(x)) if x[i] in at_rest]
    point = solved(values, rates)
    slopes = [[rounded(slope(g, point, j)) for j in range(len(names))] for g in fs + hs]
    return (
        f'    {{"{name}", {"true" if domain == "c" else "false"},\n     {quoted(x)}, {quoted(u)},\n     {quoted(f)},\n'
        f"     {quoted(h)},\n     {quoted(values)},\n     {quoted(at_rest)},\n"
        f"     {listed(map(rounded, point))},\n     {listed(rounded(g(point)) for g in hs)},\n"
        f"     {listed(listed(r) for r in slopes)}}},\n"
    )


print(
    """// SPDX-License-Identifier: MIT
// Plants of equations, their operating points and their slopes, rounded to doubles: by linearisation_reference.py.
#pragma once

#include <string>
#include <vector>

struct LinearisationReference {
  std::string name;
  bool is_continuous;
  std::vector<std::string> states, inputs, f, h, values, steady;
  std::vector<double> point, y;             // states, then inputs; outputs
  std::vector<std::vector<double>> slopes;  // of f, then of h, over states and inputs
};

// clang-format off
inline const std::vector<LinearisationReference> linearisation_references = {"""
)
print("".join(map(row, PLANTS)), end="")
print("};\n// clang-format on")
