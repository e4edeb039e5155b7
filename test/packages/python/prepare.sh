#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The wheel, and two Pythons that have it: `full` with the packages that it works together with, `bare` with none.
#
#   LQG_BUILD=<build> prepare.sh <root of the source tree> <folder>
set -euo pipefail
root=$1 folder=$2
mkdir -p "$folder"
rm -f "$folder"/*/ready

"$root/ports/packages/python/make.sh" "$root" "$folder/wheel"
for environment in full bare; do
  [ -x "$folder/$environment/bin/python" ] || python3 -m venv "$folder/$environment"
done
pip_install() {
  local environment=$1
  shift
  "$folder/$environment/bin/python" -m pip install --quiet --disable-pip-version-check "$@"
}
pip_install full numpy scipy control h5py hypothesis matplotlib tqdm joblib nbclient ipykernel \
  "cyclonedx-python-lib[json-validation]" || {
  echo "Not found: numpy, scipy, control, h5py, hypothesis, matplotlib, tqdm, joblib, nbclient, ipykernel," \
    "cyclonedx-python-lib on PyPI"
  exit 0
}
for environment in full bare; do
  pip_install "$environment" --no-index --force-reinstall --no-deps "$folder"/wheel/*.whl
  touch "$folder/$environment/ready"
done
