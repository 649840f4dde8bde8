#!/usr/bin/env bash
# Installs what is missing, builds clv, and renders the default scene: its direct, indirect and combined light, the
# path-traced reference, and the error of the light volume.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source scripts/setup.sh

installPackages "${buildPackages[@]}"
buildPreset release clv_cli
build/release/clv render --scene atrium --bounces all --rays 16M --samples 256 --out demo-out
echo "The pictures are in $PWD/demo-out: direct, indirect, combined and reference as .png and .exr, and error.png."
