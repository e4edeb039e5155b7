# SPDX-License-Identifier: MIT
"""Files and values that somebody made to do harm: each is refused by a DesignError or arrives as what it says, and
nothing is written but NAME.toml."""

import contextlib
import io
import json
import math
import os
import random
import re
import tomllib
import unittest
from pathlib import Path
from unittest import mock

import h5py
import hypothesis
import numpy
import scipy.io
from hypothesis import strategies

import mat_bytes
import tinylqg
import tinylqg.__main__
import tinylqg.mat_file
from designs import SOURCE, InFolder
from plants import PLANT, WEIGHTS, cells, save

DESIGN = SOURCE / "codegen" / "designs" / "two_mass.toml"
hypothesis.settings.register_profile("hostile", derandomize=True, database=None, deadline=None, max_examples=300)
hypothesis.settings.load_profile("hostile")

texts = strategies.text() | strategies.sampled_from(
    [
        "../victim/config",
        "/victim",
        "a/b",
        "..",
        "",
        "\n[code]\nreal = 1",
        '"',
        "'",
        "\\",
        "a.b",
        "a b",
        "é",
        "\0",
        "\x7f",
        "\ud800",
        "\u2028",
        "\x1b[2J",
        "a" * 400,
        "]",
        "#",
        "=",
        "__class__",
        "two\nmass",
    ]
)
numbers = strategies.floats() | strategies.integers() | strategies.sampled_from([2**63 - 1, -(2**63), 2**64, 10**400])
values = strategies.recursive(
    numbers | texts,
    lambda inner: strategies.lists(inner, max_size=3) | strategies.dictionaries(texts, inner, max_size=3),
    max_leaves=8,
)


def tree(folder):
    """All files below, with what is in them."""
    return {str(path): path.read_bytes() for path in Path(folder).rglob("*") if path.is_file()}


def quiet_main(*words):
    with contextlib.redirect_stderr(io.StringIO()) as said:
        return tinylqg.__main__.main(words), said.getvalue()


def in_this_process():
    """The readers of .mat files without a process of their own: for many files, none of which crashes them."""
    return mock.patch("tinylqg.apart.variables", tinylqg.mat_file.variables_in)


def same(one, other):
    """NaN equals itself, and a text no number."""
    if isinstance(one, dict):
        return isinstance(other, dict) and one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, list):
        return isinstance(other, list) and len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, float) and math.isnan(one):
        return isinstance(other, float) and math.isnan(other)
    return isinstance(one, str) == isinstance(other, str) and one == other


class Confined(InFolder):
    def setUp(self):
        super().setUp()
        Path("victim").mkdir()
        Path("victim/config.toml").write_text("precious = true\n")
        Path("work").mkdir()
        os.chdir("work")

    def test_name_of_a_file_elsewhere_writes_nothing(self):
        save("plant.mat", **PLANT, **WEIGHTS, name="../victim/config")
        before = tree(self.folder)
        status, said = quiet_main("import", "plant.mat", "--sample-time", "0.1", "--force")
        self.assertEqual((status, tree(self.folder)), (2, before))
        self.assertEqual(
            said,
            "name: expected at most 31 lower-case letters, digits and _, a letter first, found '../victim/config'\n",
        )

    @hypothesis.given(texts)
    def test_any_name_writes_its_own_file_or_none(self, name):
        save("plant.mat", **PLANT, **WEIGHTS)
        before = tree(self.folder)
        with in_this_process():
            status, _ = quiet_main("import", "plant.mat", "--sample-time", "0.1", "--force", "--name=" + name)
        new = {key: data for key, data in tree(self.folder).items() if before.get(key) != data}
        if status == 0:
            self.assertEqual(list(new), [str(self.folder / "work" / f"{name}.toml")])
            self.assertEqual(tomllib.loads(Path(f"{name}.toml").read_text())["name"], name)
            Path(f"{name}.toml").unlink()
        else:
            self.assertEqual((status, new), (2, {}))

    def test_link_to_another_file_is_not_followed(self):
        save("motor.mat", **PLANT, **WEIGHTS)
        for target in ("../victim/config.toml", "../victim/new.toml"):
            Path("motor.toml").symlink_to(target)
            before = tree(self.folder)
            status, said = quiet_main("import", "motor.mat", "--sample-time", "0.1")
            self.assertEqual((status, tree(self.folder)), (2, before))
            self.assertIn("expected a file that is not there yet", said)
            Path("motor.toml").unlink()

    def test_messages_have_no_control_characters(self):
        save("plant.mat", **PLANT, name="\x1b]0;owned\x07\nwrote motor.toml")
        _, said = quiet_main("import", "plant.mat", "--sample-time", "0.1")
        self.assertTrue(said.endswith("\n") and said[:-1].isprintable(), said)


class Texts(InFolder):
    @hypothesis.given(strategies.dictionaries(texts, values, max_size=4))
    @hypothesis.example({"a] \n[evil": 1.0, 'x" = 1\ny': "\"\n", "code.real": {"b = 1\n": [math.nan, -math.inf]}})
    def test_every_key_and_value_reads_back_as_it_was(self, table):
        try:
            text = tinylqg.design_text(([[1.0]], [[1.0]]), domain="discrete", sample_time=1, name="x", lqr=table)
        except tinylqg.DesignError:
            self.assertTrue(
                self.has(
                    table,
                    lambda item: (
                        isinstance(item, int)
                        and abs(item) >= 2**63
                        or isinstance(item, str)
                        and any("\ud800" <= c <= "\udfff" for c in item)
                    ),
                ),
                table,
            )
            return
        found = tomllib.loads(text)
        self.assertEqual(found.keys() - {"lqr"}, {"name", "plant"})
        self.assertTrue(same(table, found.get("lqr", {})), text)

    def has(self, value, is_wrong):
        if isinstance(value, dict):
            return any(is_wrong(key) or self.has(item, is_wrong) for key, item in value.items())
        return any(self.has(item, is_wrong) for item in value) if isinstance(value, list) else is_wrong(value)

    def test_what_no_design_file_can_have(self):
        endless = []
        endless.append(endless)
        deep = {"a": 1}
        for _ in range(2000):
            deep = {"a": deep}
        for section, value in (
            ("lqr", {"a": endless}),
            ("lqr", deep),
            ("lqr", {"a": {1}}),
            ("lqr", {1: 2}),
            ("lqr", [1]),
            ("lqr", "Q"),
            ("stage", {"from": 1}),
            ("stage", [1]),
            ("stage", "abc"),
            ("lqr", {"a": b"b"}),
            ("kalman", 1),
            ("lqr", {"a": True}),
            ("lqr", {"a": 10**5000}),
            ("lqr", {"\ud800": 1}),
        ):
            with self.refused(section):
                tinylqg.design_text(([[1]], [[1]]), domain="discrete", sample_time=1, name="x", **{section: value})
        for key, value in (
            ("sample_time", [1, 2]),
            ("sample_time", 10**400),
            ("domain", [1]),
            ("domain", 1),
            ("sample_time", numpy.ones(3)),
            ("domain", numpy.ones(2)),
            ("sample_time", 1j),
            ("name", 5),
            ("name", ["x"]),
            ("name", None),
            ("name", "x" * 40),
        ):
            keys = {"domain": "discrete", "sample_time": 1, "name": "x", key: value}
            with self.refused(key):
                tinylqg.design_text(([[1]], [[1]]), **keys)
        with self.refused("plant.sample_time"):
            tinylqg.design_text(([[1]], [[1]], None, None, "soon"), name="x")


class MatlabFiles(InFolder):
    def outcome(self):
        """The design file's tables, or None where it is refused."""
        try:
            return tomllib.loads(
                tinylqg.design_text(**{"name": "x", "sample_time": 0.1, **tinylqg.read_mat("plant.mat")})
            )
        except tinylqg.DesignError as error:
            self.assertTrue(str(error).isprintable(), error)
            return None

    # savemat writes ASCII, leaves out what begins with _ or a digit, and ends names at a zero.
    fields = strategies.text(
        strategies.characters(max_codepoint=127, exclude_characters="\0"), min_size=1, max_size=31
    ).filter(lambda name: name[0] not in "_0123456789")

    @hypothesis.given(
        strategies.dictionaries(
            fields,
            texts.filter(lambda text: "\ud800" not in text and "\0" not in text)
            | strategies.floats()
            | strategies.complex_numbers(),
            min_size=1,
            max_size=4,
        )
    )
    @hypothesis.example({"Q] \n[code": 1.0, 'x" = 1': "a\n[b]"})
    def test_fields_are_keys_of_their_section_only(self, fields):
        save("plant.mat", **PLANT, lqr=fields)
        with in_this_process():
            found = self.outcome()
        if found is None:
            return
        self.assertEqual(found.keys() - {"lqr"}, {"name", "plant"})
        self.assertLessEqual(found.get("lqr", {}).keys(), fields.keys())
        for key, value in fields.items():
            if isinstance(value, str) and value.isalpha() and value.isascii():
                self.assertEqual(found["lqr"][key], value)

    hostile = [
        numpy.nan,
        numpy.inf,
        -numpy.inf,
        1e308,
        5e-324,
        1j,
        numpy.full((2, 2), numpy.nan),
        numpy.full((2, 2), 1e300),
        "text",
        "",
        "\n[code]\n",
        numpy.array([[1 + 1j]]),
        numpy.zeros((0, 3)),
        numpy.ones((3, 1, 2)),
        {"a": {"b": {"c": "\""}}},
        numpy.array(["x", {"a": 1.0}, 3.0], dtype=object),
        numpy.array([[2**64 - 1]], dtype=numpy.uint64),
        numpy.array([[-(2**63)]], dtype=numpy.int64),
        numpy.array([], dtype=object),
        numpy.array([["ab"], ["cd"]]),
    ]

    def test_every_value_in_every_variable(self):
        for key in (
            "A",
            "B",
            "C",
            "D",
            "G",
            "H",
            "Q",
            "R",
            "N",
            "W",
            "V",
            "Swv",
            "x0",
            "P0",
            "u_min",
            "u_rate",
            "delay",
            "states",
            "inputs",
            "Ts",
            "sample_time",
            "domain",
            "name",
            "brief",
            "lqr",
            "kalman",
            "stage",
            "code",
            "limits",
        ):
            for value in self.hostile:
                for variables in ({**PLANT, **WEIGHTS, key: value}, {"plant": {**PLANT, **WEIGHTS, key: value}}):
                    save("plant.mat", **variables)
                    with in_this_process():
                        found = self.outcome()
                    self.assertTrue(found is None or {"name", "plant"} <= found.keys())

    def write(self, *elements):
        Path("plant.mat").write_bytes(mat_bytes.file_of(*elements))

    def test_depth_without_end_is_refused(self):
        for outer in (mat_bytes.cell, mat_bytes.structure):
            for depth in (20, 900, 100000):
                data = mat_bytes.nested(outer, min(depth, 2000), b"lqr")
                for elements in ([data], [mat_bytes.compressed(data)]):
                    self.write(*elements)
                    with self.refused("plant.mat: expected"):
                        tinylqg.read_mat("plant.mat")

    def test_little_that_unpacks_to_much_is_refused(self):
        self.write(mat_bytes.compressed(mat_bytes.element(mat_bytes.MATRIX, bytes(2**27))))
        self.assertLess(Path("plant.mat").stat().st_size, 2**18)
        with self.refused("plant.mat", "unpacked"):
            tinylqg.read_mat("plant.mat")

    def test_numbers_of_a_kind_that_is_none_are_refused(self):
        """scipy looks up the kind in a table, and beyond its end: that it crashes is no wonder."""
        self.write(mat_bytes.array(mat_bytes.DOUBLE, mat_bytes.element(0xFF09, bytes(8)), b"A"))
        with self.refused("plant.mat: expected a .mat file"):
            tinylqg.read_mat("plant.mat")

    def test_damaged_files(self):
        save(
            "plant.mat",
            **PLANT,
            **WEIGHTS,
            states=cells("a", "b"),
            lqr={"horizon": 5.0, "bryson": {"states": [1.0, 2.0]}},
        )
        whole = Path("plant.mat").read_bytes()
        source = random.Random(3)
        for _ in range(20):
            data = bytearray(whole)
            data[source.randrange(128, len(data))] ^= 1 << source.randrange(8)
            Path("plant.mat").write_bytes(data)
            self.outcome()

    def test_sparse_matrix_with_entries_outside_is_refused(self):
        self.write(mat_bytes.sparse((0, 1), b"A"))
        with self.refused("sample_time"):
            tinylqg.design_text(**tinylqg.read_mat("plant.mat"), name="x")
        for rows in ((0, 2), (0, 10**8), (-1, 0)):
            self.write(mat_bytes.sparse(rows, b"A"))
            with self.refused("plant.mat: expected a .mat file"):
                tinylqg.read_mat("plant.mat")

    def test_large_sparse_matrix_is_refused(self):
        with open("plant.mat", "wb") as file:
            scipy.io.savemat(file, {"A": scipy.sparse.csc_matrix((10**6, 10**6))})
        with self.refused("at most 1000000 numbers", "A of 1000000 × 1000000"):
            tinylqg.read_mat("plant.mat")

    def test_system_that_Octave_did_not_make_is_refused(self):
        save("plant.mat", sys=scipy.io.matlab.MatlabObject(numpy.zeros((1, 1), dtype=[("e", object)]), "ss"))
        with self.refused("plant.mat: expected"):
            tinylqg.read_mat("plant.mat")


class Hdf5Files(InFolder):
    """MATLAB's version 7.3."""

    def setUp(self):
        super().setUp()
        self.file = h5py.File("plant.mat", "w", userblock_size=512)
        for key, value in PLANT.items():
            self.file[key] = numpy.atleast_2d(value).T

    def refuses(self, *parts):
        self.file.close()
        with open("plant.mat", "r+b") as file:
            file.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
        with self.refused("plant.mat: expected", *parts):
            tinylqg.read_mat("plant.mat")

    def test_links_to_other_files_are_refused(self):
        with h5py.File("secret.mat", "w") as other:
            other["Q"] = numpy.eye(2)
        self.file["Q"] = h5py.ExternalLink("secret.mat", "/Q")
        self.refuses("Q, which is a link")

    def test_links_to_nothing_are_refused(self):
        self.file["Q"] = h5py.SoftLink("/nowhere")
        self.refuses("Q, which is a link")

    def test_numbers_in_other_files_are_refused(self):
        Path("secret").write_bytes(bytes(32))
        self.file.create_dataset("Q", (2, 2), dtype="f8", external="secret")
        self.refuses("Q, which has its numbers elsewhere")

    def test_numbers_of_other_variables_are_refused(self):
        layout = h5py.VirtualLayout((2, 2), "f8")
        layout[:] = h5py.VirtualSource("secret.mat", "Q", (2, 2))
        self.file.create_virtual_dataset("Q", layout)
        self.refuses("Q, which has its numbers elsewhere")

    def test_structure_in_itself_is_refused(self):
        group = self.file.create_group("lqr")
        group["a"] = group
        self.refuses("at most 8 in each other")

    def test_cell_in_itself_is_refused(self):
        cell = self.file.create_dataset("states", (2,), dtype=h5py.ref_dtype)
        cell[0] = cell[1] = cell.ref
        self.refuses("at most 8 in each other")

    def test_structures_that_multiply_are_refused(self):
        inner = self.file.create_group("#refs#")
        for level in range(7):
            outer = self.file.create_group(f"#level{level}")
            for i in range(30):
                outer[str(i)] = inner
            inner = outer
        self.file["lqr"] = inner
        self.refuses("at most 1000 arrays")

    def test_matrices_that_are_not_there_are_refused(self):
        self.file.create_dataset("Q", (10**6, 10**6), dtype="f8", chunks=(10, 10))
        self.refuses("Q of 1000000 × 1000000")

    def test_long_entries_are_refused(self):
        self.file.create_dataset("Q", (1, 1), dtype="S100000000", chunks=(1, 1))
        self.refuses("an entry of which has 100000000 bytes")

    def test_classes_and_texts_that_are_none_are_refused(self):
        for kind, value in (
            (b"char", [[2.0**40]]),
            (b"char", [[-1]]),
            (b"char", [[0.5]]),
            (b"\xff", [[1.0]]),
            (3, [["x"]]),
            ("cell", [["y"]]),
        ):
            with self.subTest(kind=kind, value=value):
                if "Q" in self.file:
                    del self.file["Q"]
                self.file["Q"] = value
                self.file["Q"].attrs["MATLAB_class"] = kind
        self.refuses("")

    def test_types_are_no_variables(self):
        self.file["Q"] = numpy.dtype("f8")
        self.refuses("Q")

    def test_damaged_file_is_refused(self):
        self.file.close()
        data = Path("plant.mat").read_bytes()
        for size in (1000, len(data) // 2, len(data) - 100):
            Path("plant.mat").write_bytes(b"MATLAB 7.3".ljust(512) + data[512:size])
            with self.refused("plant.mat: expected a .mat file"):
                tinylqg.read_mat("plant.mat")


class Results(InFolder):
    def refuses(self, data):
        Path("x.json").write_bytes(data if isinstance(data, bytes) else json.dumps(data).encode())
        with self.refused("x.json: "):
            tinylqg.load("x.json")

    def test_files_that_no_lqgen_wrote_are_refused(self):
        matrices = {"A": [[1]], "B": [[1]], "C": [[1]], "D": [[0]], "states": ["x"], "inputs": ["u"], "outputs": ["y"]}
        for data in (b"[" * 100000, b'{"a":' * 100000, b"\xff", b"", b"1" * 10000, b'"\\ud800"', b"null"):
            self.refuses(data)
        for plant in (
            None,
            [],
            1,
            "x",
            {},
            {**matrices, "A": 1},
            {**matrices, "A": []},
            {**matrices, "A": [[1, 2]]},
            {**matrices, "A": [["x"]]},
            {**matrices, "B": [[1], [2]]},
            {**matrices, "D": [[1, 2]]},
            {**matrices, "C": {}},
            {**matrices, "states": [1]},
            {**matrices, "inputs": "u"},
            {**matrices, "A": [[None]]},
        ):
            self.refuses({"lqgen": "0", "name": "x", "plant": plant})
        for name in ("../victim", 1, None, "x\n", ["x"]):
            self.refuses({"lqgen": "0", "name": name, "plant": matrices})
        for key, value in (
            ("loop", 1),
            ("kalman", []),
            ("stages", 1),
            ("stages", [1]),
            ("stages", [{}]),
            ("lqr", {"poles": [[1]]}),
            ("lqr", {"poles": [1]}),
            ("lqr", {"K": [[1], [1, 2]]}),
            ("stages", [{"plant": {}}]),
        ):
            self.refuses({"lqgen": "0", "name": "x", "plant": matrices, key: value})

    @hypothesis.given(strategies.data())
    def test_one_value_of_a_design_replaced(self, data):
        if not Path("two_mass.json").exists():
            tinylqg.generate(DESIGN)
        tables = json.loads(Path("two_mass.json").read_text())
        owner = tables
        while True:
            key = data.draw(strategies.sampled_from(sorted(owner) if isinstance(owner, dict) else range(len(owner))))
            if not isinstance(owner[key], (dict, list)) or not owner[key] or data.draw(strategies.booleans()):
                break
            owner = owner[key]
        owner[key] = data.draw(strategies.none() | strategies.booleans() | values)
        Path("x.json").write_text(json.dumps(tables))
        with contextlib.suppress(tinylqg.DesignError):
            tinylqg.load("x.json")
        self.assertIn(quiet_main("export", "x.json")[0], (0, 2))


class DesignFiles(InFolder):
    def test_name_is_what_TOML_says(self):
        before, rest = re.split('^name *= *"two_mass"', DESIGN.read_text(), flags=re.MULTILINE)
        for line in (
            r'name = "two\u005fmass"',
            "'name' = 'two_mass'",
            r'"na\u006de" = "two_mass"',
            '# name = "x"\nname="two_mass"',
            "name = 'two_mass' # x",
        ):
            Path("x.toml").write_text(before + line + rest)
            self.assertEqual(tinylqg.generate("x.toml").name, "two_mass")

    def test_file_whose_name_is_an_option(self):
        Path("--help").write_bytes(DESIGN.read_bytes())
        self.assertEqual(tinylqg.generate("--help").name, "two_mass")


if __name__ == "__main__":
    unittest.main()
