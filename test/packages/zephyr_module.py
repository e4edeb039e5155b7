# SPDX-License-Identifier: MIT
"""zephyr_module.py FOLDER: zephyr/module.yml has only keys that Zephyr's schema for modules knows, and what they name
is there. Keys: Zephyr documentation, "Modules (External projects)", "Module yaml file description"."""

import pathlib
import sys

import yaml

known = {"name", "build", "samples", "tests", "boards", "blobs", "runners", "security", "package-managers"}
known_build = {
    "cmake",
    "kconfig",
    "cmake-ext",
    "kconfig-ext",
    "depends",
    "settings",
    "sysbuild-cmake",
    "sysbuild-kconfig",
}

folder = pathlib.Path(sys.argv[1])
module = yaml.safe_load((folder / "zephyr/module.yml").read_text())
sample = yaml.safe_load((folder / "samples/mass/sample.yaml").read_text())

problems = [f"unknown key {key}" for key in (module.keys() - known) | (module["build"].keys() - known_build)]
if module["name"] != "tinylqg":
    problems.append(f"expected the name tinylqg, found {module['name']}")
wanted = [folder / module["build"]["cmake"] / "CMakeLists.txt", folder / module["build"]["kconfig"]]
wanted += [folder / name for name in module["samples"]]
problems += [f"{path} is not there" for path in wanted if not path.exists()]
if not sample["tests"] or not all(name.startswith("sample.tinylqg.") for name in sample["tests"]):
    problems.append("samples/mass/sample.yaml: expected tests named sample.tinylqg.…")
sys.exit("\n".join(problems) or None)
