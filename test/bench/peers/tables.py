# SPDX-License-Identifier: MIT
"""tables.py RESULTS: what run.sh has measured as tables of Markdown, means first."""

import sys
from statistics import geometric_mean

from results import PEERS, Results

CONTESTANTS = {
    "plain": "TinyLQG",
    "fused": "fused",
    "cheapest": "cheapest",
    "compact": "compact",
    "eigen": "Eigen",
    "cmsis": "CMSIS-DSP",
    "symforce": "SymForce",
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
FORMS = (
    ("constant", "plain"),
    ("constant", "cheapest"),
    ("constant", "compact"),
    ("carried", "plain"),
    ("carried", "fused"),
    ("carried", "compact"),
)


def row(cells):
    print(f"| {' | '.join(cells)} |")


def heading(cells, texts):
    row(cells)
    row(["---"] * texts + ["---:"] * (len(cells) - texts))


def shown(value, measure):
    if value is None:
        return "–"
    return f"{value:.2f}" if measure == "ratio" else f"{value:.0f}"


def mean(results, core, measure, form, peers):
    kind, contestant = form
    ratios = [results.ratio(core, model, contestant, peers, measure) for model in results.models if model[1] == kind]
    ratios = [ratio for ratio in ratios if ratio is not None]
    return f"{geometric_mean(ratios):.2f}" if ratios else "–"


def print_means(results, title, peers):
    print(f"### {title}\n")
    heading(["core", "measure"] + [f"{kind}, {CONTESTANTS[name]}" for kind, name in FORMS], 2)
    for core in results.cores:
        for measure, name in MEANS.items():
            means = [mean(results, core, measure, form, peers) for form in FORMS]
            if set(means) != {"–"}:
                row([core, name, *means])
    print()


def print_table(results, core, measure):
    names = [
        name
        for name in CONTESTANTS
        if any(results.value(core, model, name, measure) is not None for model in results.models)
    ]
    if not names:
        return
    is_time = measure == "ratio"
    print(f"### {core}: {MEASURES[measure]}\n")
    heading(["model", "gain"] + ["ns"] * is_time + [CONTESTANTS[name] for name in names], 2)
    for model in results.models:
        if results.value(core, model, "plain", measure) is None:
            continue
        values = [shown(results.value(core, model, name, measure), measure) for name in names]
        ns = [f"{results.value(core, model, 'plain', 'ns'):.1f}"] if is_time else []
        row([*model, *ns, *values])
    print()


def main():
    results = Results(sys.argv[1])
    print("## Means\n")
    print("Geometric means of the ratios of all models: below 1 TinyLQG needs less.\n")
    print_means(results, "Over the best of the others, for each model and measure", PEERS)
    print_means(results, "Over SymForce", ("symforce",))
    print_means(results, "Over Eigen", ("eigen",))
    print("## Models\n")
    for core in results.cores:
        for measure in MEASURES:
            print_table(results, core, measure)


main()
