# SPDX-License-Identifier: MIT
"""The schema of the design file accepts what lqgen accepts and refuses what lqgen refuses; that of NAME.json holds for
what lqgen writes."""

import json
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

from jsonschema import Draft202012Validator

LQGEN, ROOT = (Path(argument) for argument in sys.argv[1:])
BASE = (ROOT / "test/codegen/command_line/base.toml").read_text(encoding="utf-8")
DESIGNS = sorted(
    path
    for folder in ("codegen/designs", "test/designs", "test/proof/designs", "test/codegen")
    for path in (ROOT / folder).rglob("*.toml")
)

# What is put in the place of what: errors that are made when a file is typed.
ERRORS = {
    "a misspelt key": ('sample_time', 'sampletime'),
    "a key in capitals": ('Q = [1', 'q = [1'),
    "a key of another tool": ('sample_time = 0.5', 'Ts = 0.5'),
    "an unknown table": ('[limits]', '[limit]'),
    "a missing key": ('sample_time = 0.5', ''),
    "a missing weight": ('R = [16]', ''),
    "a missing noise": ('process_noise = [0.01]', ''),
    "a word that is none of the list": ('cost = "sampled"', 'cost = "sample"'),
    "a word in capitals": ('real = "float"', 'real = "Float"'),
    "a number as text": ('sample_time = 0.5', 'sample_time = "½"'),
    "a sample time of 0": ('sample_time = 0.5', 'sample_time = 0'),
    "a number for an array": ('R = [16]', 'R = 16'),
    "an array for a matrix": ('B = [[0], [1], [0], [0]]', 'B = [0, 1, 0, 0]'),
    "text in a matrix": ('B = [[0], [1]', 'B = [[0], ["1;"]'),
    "an infinite entry": ('B = [[0], [1]', 'B = [[0], ["∞"]'),
    "a parameter that no name has": ('[plant]', '[parameters]\n"m 1" = 2\n[plant]'),
    "a unit alone": ('[plant]', '[parameters]\nm = { unit = "kg" }\n[plant]'),
    "a negative weight": ('R = [16]', 'R = [-16]'),
    "a negative variance": ('process_noise = [0.01]', 'process_noise = [-0.01]'),
    "a name in capitals": ('name = "base"', 'name = "Base"'),
    "a name that is no identifier": ('name = "base"', 'name = "two masses"'),
    "a name too long": ('name = "base"', f'name = "{"a" * 32}"'),
    "two lines in one": ('brief = "two', 'brief = "two\\n'),
    "a unit without brackets": ('"dy1 [m]"', '"dy1 m"'),
    "no program memory": ('flash = 16384', 'flash = 0'),
    "half a byte": ('flash = 16384', 'flash = 0.5'),
    "Q twice": ('Q = [1', 'Q_output = [1, 1]\nQ = [1'),
    "R twice": ('Q = [1, 0, 1, 0]', 'bryson = { states = [1, 1, 1, 1], inputs = [1] }'),
    "decay twice": ('R = [16]', 'R = [16]\ndecay = 1.1\nsettling_time = 3'),
    "two regulators": ('[limits]', '[pole_placement]\npoles = [0.1, 0.2, 0.3, 0.4]\n[limits]'),
    "two estimators": ('[limits]', '[observer]\npoles = [0.1, 0.2, 0.3, 0.4]\n[limits]'),
    "no limits": ('u_min = [-1]\nu_max = [1]', ''),
    "an output twice": ('R = [16]', 'R = [16]\ntrack = [0, 0]'),
    "a stage without a beginning": ('[limits]', '[[stage]]\nR = [1]\n[limits]'),
    "a requirement of 0": ('[limits]', '[require]\ndisk_margin = 0\n[limits]'),
}

# What looks wrong and is right.
GOOD = {
    "an expression": ('sample_time = 0.5', 'sample_time = "1/2"'),
    "an expression in a matrix": ('B = [[0], [1]', 'B = [[0], ["cos(0)"]'),
    "parameters": ('[plant]', '[parameters]\nk = "2*m"\nm = { value = 2, unit = "kg" }\n[plant]'),
    "no limit": ('u_max = [1]', 'u_max = [inf]'),
    "no gate": ('gain = "steady"', 'spike = inf'),
    "an output by name": ('R = [16]', 'R = [16]\ntrack = ["y1"]'),
    "an output by number": ('R = [16]', 'R = [16]\ntrack = [0]'),
    "a structure by names": ('R = [16]', 'R = [16]\nstructure = [["dy1", "v1", "dy2"]]'),
    "a state that nothing corrects": ('gain = "steady"', 'structure = [["y1"], ["y1", "y2"], ["y2"], []]'),
    "recovery by a number": ('gain = "steady"', 'recovery = 0.5'),
    "a name without a unit": ('"dy1 [m]"', '"dy1"'),
    "a full weight": ('R = [16]', 'R = [[16]]'),
}


class Schemas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        printed = subprocess.run([LQGEN, "--schema"], check=True, capture_output=True).stdout
        schema = json.loads(printed)
        Draft202012Validator.check_schema(schema)
        cls.validator = Draft202012Validator(schema)

    def changed(self, change):
        old, new = change
        self.assertEqual(BASE.count(old), 1, old)
        return BASE.replace(old, new)

    def errors(self, text):
        return [f"{error.json_path}: {error.message}" for error in self.validator.iter_errors(tomllib.loads(text))]

    def status(self, text):
        with tempfile.TemporaryDirectory() as folder:
            command = [LQGEN, "-", "-o", folder, "--only", "json", "--quiet"]
            return subprocess.run(command, input=text.encode(), capture_output=True).returncode

    def test_every_design_of_this_project_is_accepted(self):
        self.assertGreater(len(DESIGNS), 20)
        for design in DESIGNS:
            with self.subTest(design=design.name):
                self.assertEqual(self.errors(design.read_text(encoding="utf-8")), [])

    def test_typical_errors_are_refused_here_and_by_lqgen(self):
        for error, change in ERRORS.items():
            with self.subTest(error=error):
                text = self.changed(change)
                self.assertEqual(self.status(text), 2)
                self.assertNotEqual(self.errors(text), [])

    def test_what_looks_wrong_is_accepted_here_and_by_lqgen(self):
        for design, change in GOOD.items():
            with self.subTest(design=design):
                text = self.changed(change)
                self.assertEqual(self.errors(text), [])
                self.assertEqual(self.status(text), 0)

    def test_an_infinite_number_that_became_null_is_accepted(self):
        design = tomllib.loads(BASE)
        design["limits"]["u_max"] = [None]
        self.assertEqual(list(self.validator.iter_errors(design)), [])

    def test_what_lqgen_writes_is_as_its_schema_says(self):
        schema = json.loads((ROOT / "codegen/result.schema.json").read_text(encoding="utf-8"))
        Draft202012Validator.check_schema(schema)
        validator = Draft202012Validator(schema)
        for design in DESIGNS:
            with self.subTest(design=design.name), tempfile.TemporaryDirectory() as folder:
                subprocess.run([LQGEN, design, "-o", folder, "--only", "json", "--quiet"], check=True)
                (written,) = Path(folder).iterdir()
                result = json.loads(written.read_text(encoding="utf-8"))
                errors = [f"{error.json_path}: {error.message[:200]}" for error in validator.iter_errors(result)]
                self.assertEqual(errors, [])
                self.assertNotEqual(list(validator.iter_errors({**result, "gain": 1})), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
