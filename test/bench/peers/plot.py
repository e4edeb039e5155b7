# SPDX-License-Identifier: MIT
"""plot.py RESULTS FILE.svg: each model's cost over that of the best peer, on a logarithmic scale. The same results make
the same bytes."""

import io
import re
import sys

import matplotlib as mpl

mpl.use("svg")

import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
from results import PEERS, Results

FORMS = {
    "plain": ("straight lines", "o", "#0072b2"),
    "cheapest": ("cheapest form", "D", "#009e73"),
    "compact": ("compact style", "s", "#d55e00"),
}
PANELS = (("cortex-m4f", "cycles", "cycles, Cortex-M4F"), ("x86-64", "ratio", "time, x86-64"))
KINDS = {"constant": "constant gain", "carried": "covariance carried along"}


def draw(axes, results, kind, core, measure):
    models = [model for model in results.models if model[1] == kind]
    for shift, (contestant, (label, marker, colour)) in enumerate(FORMS.items()):
        if kind == "carried" and contestant == "cheapest":
            continue
        ratios = [results.ratio(core, model, contestant, PEERS, measure) for model in models]
        points = [(i + 0.2 * (shift - 1), ratio) for i, ratio in enumerate(ratios) if ratio is not None]
        axes.plot(*zip(*points), marker, color=colour, label=label, markersize=5)
    axes.axhline(1, color="black", linewidth=0.8)
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(FixedLocator([1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8, 16]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}" if value >= 1 else f"1/{1 / value:.0f}"))
    axes.grid(axis="y", linewidth=0.4)
    axes.set_xticks(range(len(models)), [model[0] for model in models], rotation=45, ha="right")
    axes.margins(x=0.03)


def laid_out(line):
    """At most 120 columns: an attribute a line."""
    return line if len(line) <= 120 else re.sub(r'" (?=[\w:-]+=")', '"\n  ', line)


def main():
    results = Results(sys.argv[1])
    mpl.rcParams.update(
        {"svg.hashsalt": "peers", "svg.fonttype": "none", "font.sans-serif": ["DejaVu Sans"], "font.size": 9}
    )
    figure, panels = plt.subplots(2, 2, figsize=(10, 7), sharey=True, layout="constrained")
    for row, (kind, title) in zip(panels, KINDS.items()):
        for axes, (core, measure, name) in zip(row, PANELS):
            draw(axes, results, kind, core, measure)
            axes.set_title(f"{title}: {name}")
    figure.legend(*panels[0][0].get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False)
    figure.supylabel("TinyLQG over the best of Eigen, CMSIS-DSP and SymForce")
    drawn = io.StringIO()
    figure.savefig(drawn, format="svg", metadata=dict.fromkeys(("Creator", "Date", "Format", "Type")))
    lines = [laid_out(line.rstrip()) for line in drawn.getvalue().splitlines()]
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


main()
