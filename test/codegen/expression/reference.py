# SPDX-License-Identifier: MIT
"""Prints reference.hpp: values and slopes of formulas, by mpmath in 80 digits.

    pip install mpmath==1.3.0; python3 reference.py > reference.hpp

Each formula stands here twice: as a user writes it, and as Python of mpmath. Slopes are mpmath's numerical
derivatives in 160 digits, which know nothing of dual numbers.
"""

import mpmath as mp

X, Y = 0.7, -1.3  # the doubles

FORMULAS = [
    ("-x^2 + 3*y", lambda x, y: -(x * x) + 3 * y),
    ("x - y - 0.1", lambda x, y: (x - y) - mp.mpf(0.1)),
    ("x/y/3", lambda x, y: x / y / 3),
    ("2^x^2", lambda x, y: mp.power(2, x * x)),
    ("x^-3", lambda x, y: 1 / x**3),
    ("x^5 + y^7", lambda x, y: x**5 + y**7),
    ("x^y", lambda x, y: mp.power(x, y)),
    ("(1 + x)^2.5", lambda x, y: mp.power(1 + x, mp.mpf(2.5))),
    ("sqrt(x)*sin(y)", lambda x, y: mp.sqrt(x) * mp.sin(y)),
    ("cos(x*y) + tan(x)", lambda x, y: mp.cos(x * y) + mp.tan(x)),
    ("asin(x) + acos(x/2) + atan(y)", lambda x, y: mp.asin(x) + mp.acos(x / 2) + mp.atan(y)),
    ("atan2(y, -x)", lambda x, y: mp.atan2(y, -x)),
    ("exp(y)*log(x)", lambda x, y: mp.exp(y) * mp.log(x)),
    ("tanh(3*x) - abs(y)", lambda x, y: mp.tanh(3 * x) - abs(y)),
    ("min(x, y) + 2*max(x^2, y)", lambda x, y: min(x, y) + 2 * max(x * x, y)),
    ("--x*+y", lambda x, y: x * y),
    ("pi*x", lambda x, y: mp.pi * x),
    (
        "(y - 0.1*x + 0.2*sin(x)*(0.3*y^2 - 9.81*cos(x)))/(0.5 + 0.2*sin(x)^2)",
        lambda x, y: (
            (y - mp.mpf(0.1) * x + mp.mpf(0.2) * mp.sin(x) * (mp.mpf(0.3) * y * y - mp.mpf(9.81) * mp.cos(x)))
            / (mp.mpf(0.5) + mp.mpf(0.2) * mp.sin(x) ** 2)
        ),
    ),
]


def main():
    print("// SPDX-License-Identifier: MIT")
    print("// Made by reference.py: values and slopes of formulas at x, y, by mpmath in 80 digits.")
    print("#pragma once\n\nnamespace reference {\n")
    print(f"constexpr double x = {X}, y = {Y};\n")
    print("struct Formula {\n  const char *text, *value, *by_x, *by_y;\n};\n")
    print("const Formula formulas[] = {")
    for text, function in FORMULAS:
        with mp.workdps(160):
            x, y = mp.mpf(X), mp.mpf(Y)
            numbers = [function(x, y), mp.diff(function, (x, y), (1, 0)), mp.diff(function, (x, y), (0, 1))]
            digits = [mp.nstr(number, 70) for number in numbers]
        print(f'    {{"{text}",')
        print(",\n".join(f'     "{number}"' for number in digits) + "},")
    print("};\n\n}  // namespace reference")


if __name__ == "__main__":
    main()
