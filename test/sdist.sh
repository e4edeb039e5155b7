#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A part of a source distribution on PyPI, whose hash is checked before it is unpacked. Nothing is built, and nothing of
# it or of PyPI runs.
#
#   sdist.sh <backend> <name> <version> <requirement file> <folder> <levels to strip> [part]
#
# <backend> is the module that its pyproject.toml names, <name> the name of its archive.
set -euo pipefail
backend=$1 name=$2 version=$3 requirement=$4 folder=$5 levels=$6 part=${7:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# pip asks the build backend of a source distribution for its name and version, even if it is only to download it, and
# gets the backend from PyPI. Without isolation it takes the module that is there: this one.
module=$work/backend/${backend//.//}.py
mkdir -p "$(dirname "$module")" "$work/download"
touch "$(dirname "$module")/__init__.py"
cat >"$module" <<END
import os

NAME, VERSION = "$name", "$version"


def prepare_metadata_for_build_wheel(folder, config_settings=None):
    info = f"{NAME}-{VERSION}.dist-info"
    os.mkdir(os.path.join(folder, info))
    with open(os.path.join(folder, info, "METADATA"), "w") as file:
        file.write(f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {VERSION}\n")
    return info


def build_wheel(folder, config_settings=None, metadata_directory=None):
    raise SystemExit("Nothing is built here")
END
PYTHONPATH=$work/backend python3 -m pip download --quiet --no-deps --no-binary :all: --no-build-isolation \
  --require-hashes --requirement "$requirement" --dest "$work/download"
mkdir -p "$folder"
tar -xzf "$work/download/$name-$version.tar.gz" -C "$folder" --strip-components="$levels" \
  "$name-$version${part:+/$part}"
