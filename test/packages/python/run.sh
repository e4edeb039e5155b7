#!/usr/bin/env bash
# One file of tests with the Python that prepare.sh set up:  run.sh <environment> <test file>
set -euo pipefail
if [ ! -e "$1/ready" ]; then
  echo "Not found: $1, which package.python.prepare makes"
  exit 0
fi
exec "$1/bin/python" -B "$2" --verbose
