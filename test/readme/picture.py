# SPDX-License-Identifier: MIT
"""picture.py REPORT.html PICTURE.svg COLUMN… [--check]: makes a picture of charts of a report, as they are: columns
from the left to the right, each with the ids of its charts, "run-a-y0,run-a-u0". With --check fails where the picture
is another one."""

import re
import sys
from pathlib import Path

GAP = 20


def charts(report):
    """By their ids: width, height, title and what is drawn."""
    begin = r'data-chart="([^"]+)">\n<svg viewBox="0 0 ([\d.]+) ([\d.]+)"[^>]*aria-label="([^"]*)">\n(.*?)</svg>'
    return {found[0]: found[1:] for found in re.findall(begin, report, re.DOTALL)}


def style(report):
    """The page's rules for charts, in its light colours."""
    report = report[report.index("<style>") : report.index("</style>")]
    colours = dict(re.findall(r"(--[\w-]+): (#\w+);", report[: report.index("@media")]))
    text = "\n".join(re.findall(r"\bsvg ([.\w][^{}]*\{[^}]*\})", report))
    return re.sub(r"var\((--[\w-]+)\)", lambda found: colours[found[1]], text), colours


def folded(lines):
    """Paths in lines that people's tools can show."""
    lines = lines.replace("/><text", "/>\n<text")
    return re.sub(r"[^\n]{80,100}?(?=[LMHV]\d)", lambda found: found[0] + "\n", lines)


def placed(chart, x, y, panel):
    width, height, label, lines = chart
    return (
        f'<svg x="{x:g}" y="{y:g}" width="{width}" height="{height}" viewBox="0 0 {width} {height}">\n'
        f"<title>{label}</title>\n"
        f'<rect class="panel" width="{width}" height="{height}" fill="{panel}"/>\n{folded(lines)}</svg>\n'
    )


def picture(report, columns):
    there = charts(report)
    rules, colours = style(report)
    inner, left, height = "", 0.0, 0.0
    for column in columns:
        top, wide = 0.0, 0.0
        for chart in (there[name] for name in column.split(",")):
            inner += placed(chart, left, top, colours["--panel"])
            top, wide = top + float(chart[1]) + GAP, max(wide, float(chart[0]))
        left, height = left + wide + GAP, max(height, top - GAP)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {left - GAP:g} {height:g}" font-family="sans-serif" '
        f'font-size="11">\n<style>\n{rules}\n</style>\n{inner}</svg>\n'
    )


def main():
    words = [word for word in sys.argv[1:] if word != "--check"]
    report, target = Path(words[0]), Path(words[1])
    made = picture(report.read_text(encoding="utf-8"), words[2:])
    if "--check" not in sys.argv:
        target.write_text(made, encoding="utf-8")
    elif not target.exists() or target.read_text(encoding="utf-8") != made:
        print(f"{target}: expected the charts of the report as it is; cmake --build build --target update_golden")
        return 1
    return 0


sys.exit(main())
