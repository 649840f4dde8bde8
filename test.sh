#!/usr/bin/env bash
# Installs what is missing, builds everything, and runs the tests. Arguments go to ctest: ./test.sh -R Merge
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source scripts/setup.sh

installPackages "${buildPackages[@]}" "${testPackages[@]}"
buildPreset release
ctest --preset release "$@"
