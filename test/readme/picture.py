# SPDX-License-Identifier: MIT
"""picture.py REPORT.html PICTURE.svg [--check]: makes the README's picture of three charts of a report, as they are;
with --check fails where the picture is another one."""

import re
import sys
from pathlib import Path

GAP = 20


def charts(report):
    return re.findall(r'<svg viewBox="0 0 ([\d.]+) ([\d.]+)"[^>]*aria-label="([^"]*)">\n(.*?)</svg>', report, re.DOTALL)


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


def picture(report):
    nyquist, output, u = (
        next(chart for chart in charts(report) if chart[2].startswith(title))
        for title in ("Nyquist curve about", "angle", "voltage")
    )
    rules, colours = style(report)
    side, top = float(nyquist[0]) + GAP, float(output[1]) + GAP
    width, height = side + float(output[0]), float(nyquist[1])
    panel = colours["--panel"]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" font-family="sans-serif" '
        f'font-size="11">\n<style>\n{rules}\n</style>\n'
        + placed(nyquist, 0, 0, panel)
        + placed(output, side, 0, panel)
        + placed(u, side, top, panel)
        + "</svg>\n"
    )


def main():
    report, target = Path(sys.argv[1]), Path(sys.argv[2])
    made = picture(report.read_text(encoding="utf-8"))
    if sys.argv[3:] != ["--check"]:
        target.write_text(made, encoding="utf-8")
    elif not target.exists() or target.read_text(encoding="utf-8") != made:
        print(f"{target}: expected the charts of the report as it is; cmake --build build --target update_golden")
        return 1
    return 0


sys.exit(main())
