# SPDX-License-Identifier: MIT
"""pages.sh: a report of every shipped design, and an index that leads to each and to nothing else."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

SCRIPT, LQGEN, DESIGNS = (Path(argument) for argument in sys.argv[1:])


class Page(HTMLParser):
    """The addresses and the text of a page."""

    def __init__(self, text):
        super().__init__()
        self.addresses, self.text = [], ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.addresses += [value for name, value in attrs if name in ("href", "src")]

    def handle_data(self, data):
        self.text += data


class Pages(unittest.TestCase):
    def test_the_index_leads_to_a_report_of_every_shipped_design(self):
        with tempfile.TemporaryDirectory() as folder:
            made = Path(folder) / "made here" / "pages"
            environment = {**os.environ, "LQGEN": str(LQGEN)}
            subprocess.run([SCRIPT, made], check=True, stdout=subprocess.DEVNULL, env=environment)
            index = Page((made / "index.html").read_text(encoding="utf-8"))
            designs = [path.read_text(encoding="utf-8") for path in DESIGNS.glob("*.toml")]
            names = {re.search(r'^name *= *"(.*)"', text, re.MULTILINE)[1] for text in designs}
            self.assertEqual(len(names), len(designs))
            self.assertEqual(sorted(index.addresses), sorted(f"{name}.html" for name in names))
            self.assertEqual({path.name for path in made.iterdir()}, {"index.html", *index.addresses})
            for text in designs:
                self.assertIn(re.search(r'^brief *= *"(.*)"', text, re.MULTILINE)[1], index.text)
            for name in names:
                self.assertIn(name, Page((made / f"{name}.html").read_text(encoding="utf-8")).text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
