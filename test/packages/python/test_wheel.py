# SPDX-License-Identifier: MIT
"""What stands in the wheel beside the package: an SBOM, the licences of all that is inside, and the same bytes each
time."""

import hashlib
import json
import os
import re
import subprocess
import unittest
import zipfile
from email import message_from_bytes
from pathlib import Path

from cyclonedx.schema import OutputFormat, SchemaVersion
from cyclonedx.validation import make_schemabased_validator

import tinylqg
from designs import SOURCE, InFolder

FOLDER = Path(os.environ["TINYLQG_BUILD"]) / "test" / "packages" / "python" / "wheel"
LIBRARIES = (
    "boost",
    "chart-js",
    "cli11",
    "eigen",
    "fast-cpp-csv-parser",
    "gmp",
    "mbedtls",
    "mpfr",
    "nlohmann-json",
    "tomlplusplus",
)
MADE = Path(os.environ["TINYLQG_BUILD"]) / "codegen"


class Wheel(InFolder):
    def setUp(self):
        super().setUp()
        (self.path,) = FOLDER.glob("*.whl")
        self.info = f"tinylqg-{tinylqg.__version__}.dist-info/"

    def read(self, name):
        with zipfile.ZipFile(self.path) as wheel:
            return wheel.read(self.info + name)

    def test_sbom_is_of_its_schema_and_names_what_is_inside(self):
        text = self.read("sboms/tinylqg.cdx.json").decode()
        self.assertIsNone(make_schemabased_validator(OutputFormat.JSON, SchemaVersion.V1_6).validate_str(text))
        bom = json.loads(text)
        found = {component["bom-ref"]: component for component in bom["components"]}
        self.assertEqual(sorted(found), sorted([*LIBRARIES, "lqgen"]))
        self.assertEqual(
            found["lqgen"]["hashes"],
            [{"alg": "SHA-256", "content": hashlib.sha256(tinylqg.lqgen_path().read_bytes()).hexdigest()}],
        )
        self.assertEqual(
            {edge["ref"]: edge.get("dependsOn") for edge in bom["dependencies"] if "dependsOn" in edge},
            {"lqgen": sorted(LIBRARIES), "tinylqg": ["lqgen"]},
        )
        self.assertEqual(bom["metadata"]["component"]["version"], tinylqg.__version__)

    def test_versions_are_those_that_were_linked(self):
        said = subprocess.run([MADE / "lqgen_libraries"], capture_output=True, text=True, check=True).stdout
        versions = dict(line.split(" ") for line in said.splitlines())
        found = {
            item["bom-ref"]: item["version"] for item in json.loads(self.read("sboms/tinylqg.cdx.json"))["components"]
        }
        self.assertEqual(found, {**versions, "lqgen": tinylqg.__version__})
        notice = self.read("licenses/NOTICE").decode()
        for name, version in versions.items():
            self.assertRegex(version, r"^(\d+\.\d+|sha256-[0-9a-f]{12}$)")  # a header that has no version has a hash
            self.assertRegex(notice, rf"\n  .* {re.escape(version)} \({name}\): .*\n")

    def test_licences_travel(self):
        with zipfile.ZipFile(self.path) as wheel:
            found = {
                Path(name).name
                for name in wheel.namelist()
                if re.fullmatch(re.escape(self.info) + "licenses/[^/]+", name)
            }
        self.assertEqual(
            found,
            {
                "LICENSE",
                "NOTICE",
                "LGPL-3",
                "GPL-3",
                "MPL-2.0",
                "Apache-2.0",
                *(f"{name}.copyright" for name in LIBRARIES),
            },
        )
        for name, words in (
            ("LGPL-3", "GNU LESSER GENERAL PUBLIC LICENSE"),
            ("GPL-3", "GNU GENERAL PUBLIC LICENSE"),
            ("mpfr.copyright", "Lesser General Public"),
            ("gmp.copyright", "LGPL-3"),
            ("boost.copyright", "Boost Software License"),
            ("cli11.copyright", "Redistribution and use"),
            ("NOTICE", "covered by the GNU Lesser General Public License"),
        ):
            self.assertIn(words, " ".join(self.read("licenses/" + name).decode().split()))

    def test_made_again_it_has_the_same_bytes(self):
        Path("tools").symlink_to(FOLDER / "tools")
        again = {**os.environ, "LQG_BUILD": os.environ["TINYLQG_BUILD"], "TZ": "Pacific/Chatham", "LC_ALL": "C.UTF-8"}
        done = subprocess.run(
            ["bash", "-c", 'umask 077 && exec "$0" "$@"', SOURCE / "ports/packages/python/make.sh", SOURCE, "."],
            env=again,
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(Path(self.path.name).read_bytes(), self.path.read_bytes())

    def test_metadata_needs_nothing_on_a_new_python(self):
        needed = message_from_bytes(self.read("METADATA")).get_all("Requires-Dist")
        self.assertTrue(all("extra ==" in line or 'python_version < "3.11"' in line for line in needed), needed)

    def test_page_says_which_C_library_it_needs(self):
        major, minor = re.search(r"manylinux_(\d+)_(\d+)_", self.path.name).groups()
        self.assertIn(
            f"Linux with glibc {major}.{minor} or newer",
            " ".join((SOURCE / "ports/packages/python/README.md").read_text().split()),
        )


class Tools(unittest.TestCase):
    def test_every_tool_has_its_version_and_hashes(self):
        text = (SOURCE / "ports/packages/python/tools.txt").read_text().replace("\\\n", "")
        lines = [line for line in text.splitlines() if not line.startswith("#")]
        self.assertGreater(len(lines), 8)
        for line in lines:
            self.assertRegex(line, r"^[a-z0-9-]+==[0-9.]+ .*--hash=sha256:[0-9a-f]{64}")
        built_by = re.search(
            r"^requires = \[(.*)\]", (SOURCE / "ports/packages/python/pyproject.toml").read_text(), re.MULTILINE
        )
        for tool in re.findall(r'"(.*?)"', built_by[1]):
            self.assertTrue(any(line.startswith(tool + " ") for line in lines), tool)


if __name__ == "__main__":
    unittest.main()
