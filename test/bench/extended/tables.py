# SPDX-License-Identifier: MIT
"""tables.py RESULTS: what run.sh has measured, lines "core model contestant measure value", as tables of Markdown."""

import sys
from statistics import geometric_mean

CONTESTANTS = {
    "plain": "TinyLQG",
    "fused": "fused",
    "ud": "UD",
    "symforce": "SymForce",
    "staged": "SymForce, staged",
    "loops": "loops",
    "tinyekf": "TinyEKF",
}
MEASURES = {
    "instructions": "instructions",
    "cycles": "cycles, estimated",
    "flash": "flash, bytes",
    "ram": "RAM, bytes",
    "stack": "stack, bytes",
    "ratio": "time of a sample, over that of TinyLQG",
}
MEANS = {"instructions": "instructions", "cycles": "cycles", "flash": "flash", "memory": "RAM + stack", "ratio": "time"}
OWN, OTHERS = ("plain", "fused", "ud"), ("symforce", "staged", "loops", "tinyekf")


class Results:
    def __init__(self, path):
        self.values = {}
        with open(path, encoding="utf-8") as file:
            for line in file:
                *key, value = line.split()
                self.values[tuple(key)] = value
        self.cores, self.models = (list(dict.fromkeys(key[i] for key in self.values)) for i in (0, 1))

    def value(self, *key):
        """None where it has not been measured; memory is RAM and stack."""
        if key[-1] == "memory":
            parts = [self.value(*key[:-1], part) for part in ("ram", "stack")]
            return None if None in parts else sum(parts)
        return float(self.values[key]) if key in self.values else None

    def names(self, core, measure):
        return [name for name in CONTESTANTS if any(self.value(core, model, name, measure) for model in self.models)]

    def mean_ratio(self, core, own, other, measure):
        pairs = [[self.value(core, model, name, measure) for name in (own, other)] for model in self.models]
        return geometric_mean(a / b for a, b in pairs) if all(a and b for a, b in pairs) else None


def row(cells):
    print(f"| {' | '.join(cells)} |")


def heading(cells, texts):
    row(cells)
    row(["---"] * texts + ["---:"] * (len(cells) - texts))


def shown(value, measure):
    if value is None:
        return "–"
    return f"{value:.2f}" if measure == "ratio" else f"{value:.0f}"


def print_means(results, other):
    print(f"### Over {CONTESTANTS[other]}\n")
    heading(["core", "measure", *(CONTESTANTS[own] for own in OWN)], 2)
    for core in results.cores:
        for measure, name in MEANS.items():
            means = [results.mean_ratio(core, own, other, measure) for own in OWN]
            if any(means):
                row([core, name, *(shown(mean, "ratio") for mean in means)])
    print()


def print_answers(results):
    """The worst of all models: in float of all cores, in double of the PC."""
    names = [name for name in CONTESTANTS if any(key[2] == name for key in results.values)]
    print("## Answers\n\nThe most that x̂ and P are off, in standard deviations of x̂, over all samples and models.\n")
    heading(["real", *(CONTESTANTS[name] for name in names)], 1)
    for real, measure, scale in (("float", "error", 1e-6), ("double", "error_in_double", 1)):
        worst = [
            [float(value) for key, value in results.values.items() if key[2:] == (name, measure)] for name in names
        ]
        row([real, *(f"{scale * max(values):.0e}" if values else "–" for values in worst)])
    print()


def print_table(results, core, measure):
    names = results.names(core, measure)
    if not names:
        return
    is_time = measure == "ratio"
    print(f"### {core}: {MEASURES[measure]}\n")
    heading(["model"] + ["ns"] * is_time + [CONTESTANTS[name] for name in names], 1)
    for model in results.models:
        ns = [f"{results.value(core, model, 'plain', 'ns'):.1f}"] if is_time else []
        row([model, *ns, *(shown(results.value(core, model, name, measure), measure) for name in names)])
    print()


def main():
    results = Results(sys.argv[1])
    print_answers(results)
    print("## Means\n\nGeometric means of the ratios of all models: below 1 TinyLQG needs less.\n")
    for other in OTHERS:
        if any(key[2] == other for key in results.values):
            print_means(results, other)
    print("## Models\n")
    for core in results.cores:
        for measure in MEASURES:
            print_table(results, core, measure)


main()
