#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Unity's sources from a source distribution on PyPI, whose hash is checked before it is unpacked. Nothing is built, and nothing of it
# or of PyPI runs.
#
#   unity.sh <folder> [<requirement file>]     default: unity.txt
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$1 requirement=${2:-$here/unity.txt}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# pip asks the build backend of a source distribution for its name and version, even if it is only to download it, and gets
# the backend from PyPI. Without isolation it takes the module that is there: this one.
mkdir -p "$work/backend/hatchling" "$work/download"
touch "$work/backend/hatchling/__init__.py"
cat >"$work/backend/hatchling/build.py" <<'END'
import os

NAME, VERSION = "pytest_unity", "0.1.0"


def prepare_metadata_for_build_wheel(folder, config_settings=None):
    info = f"{NAME}-{VERSION}.dist-info"
    os.mkdir(os.path.join(folder, info))
    with open(os.path.join(folder, info, "METADATA"), "w") as file:
        file.write(f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {VERSION}\n")
    return info


def build_wheel(folder, config_settings=None, metadata_directory=None):
    raise SystemExit("Nothing is built here")
END
PYTHONPATH=$work/backend python3 -m pip download --quiet --no-deps --no-binary :all: --no-build-isolation --require-hashes \
  --requirement "$requirement" --dest "$work/download"
mkdir -p "$folder"
tar -xzf "$work"/download/pytest_unity-0.1.0.tar.gz -C "$folder" --strip-components=3 pytest_unity-0.1.0/vendor/unity
