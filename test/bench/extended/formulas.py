# SPDX-License-Identifier: MIT
"""A design of models/: its formulas over the numbers or symbols of any library."""

import tomllib


class Formulas:
    """`library` has sin, cos and their kin."""

    def __init__(self, path, library, parameters=None):
        with open(path, "rb") as file:
            design = tomllib.load(file)
        self.plant, self.filter, self.name = design["plant"], design["kalman"], design["name"]
        self.numbers = design["parameters"]
        self.parameters = self.numbers if parameters is None else parameters
        self.library = library
        self.period = self.plant["sample_time"] if self.plant["domain"] == "continuous" else 0

    def values(self, formulas, x, u=()):
        names = self.parameters | dict(zip(self.plant["states"], x)) | dict(zip(self.plant["inputs"], u))
        return [eval(text.replace("\n", " ").replace("^", "**"), self.library | names) for text in formulas]

    def f(self, x, u):
        return self.values(self.plant["f"], x, u)

    def h(self, x):
        return self.values(self.plant["h"], x)

    def wraps(self, i):
        return self.plant["outputs"][i] in self.filter.get("wraps", [])
