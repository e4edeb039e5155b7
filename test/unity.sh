#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Unity's sources from a source distribution on PyPI.
#
#   unity.sh <folder> [<requirement file>]     default: unity.txt
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
exec "$here/sdist.sh" hatchling.build pytest_unity 0.1.0 "${2:-$here/unity.txt}" "$1" 3 vendor/unity
