#!/usr/bin/env bash
# benchmarks/gpu.sh writes a pack, and a build from nothing but that pack and the source runs it: cases pass, a spoilt one is found.
# Arguments: the source, a build of all of it, a folder to work in.
set -euo pipefail
source=$1 build=$2 work=$3
gpu=$source/benchmarks/gpu.sh
expect() {
    if ! "$@"; then
        echo "failed: $*" >&2
        exit 1
    fi
}
# The command ends with this code.
endsWith() {
    local wanted=$1 code=0
    shift
    "$@" >"$work/log" 2>&1 || code=$?
    ((code == wanted)) || { cat "$work/log" >&2 && return 1; }
}
says() { grep -q -- "$1" "$work/log" || { cat "$work/log" >&2 && return 1; }; }

mkdir -p "$work"
rm -rf "$work/pack" "$work"/*.json
expect endsWith 0 "$gpu" --write-pack "$work/pack" --build "$build"
for part in commit cases/trace.case scenes/atrium.scene shaders/glsl_trace.h shaders/hlsl_trace.h include/glm/glm.hpp include/vulkan/vulkan_raii.hpp; do
    expect test -s "$work/pack/$part"
done

# As on a machine that has a compiler, CMake and a Vulkan loader alone.
expect endsWith 0 "$gpu" --pack "$work/pack" --build "$work/build" --bare --check-only --out "$work/gpu.json"
for case in trace trace_textured drawn_maps guided_rays inject_cube9_colour moving_lights slices whole_frame picture; do expect says "^pass  $case (hlsl"; done
expect grep -q '"passed":true,"cases":\[{"name":' "$work/gpu.json"
if grep -q '"passed":false' "$work/gpu.json"; then expect false; fi
expect grep -q "\"commit\":\"$(<"$work/pack/commit")\",\"command\":\"gpu.sh --pack" "$work/gpu.json"

# One time, to see that the program still takes it.
run=("$work/build/benchmarks/gpu_run/clv_gpu_run" --pack "$work/pack")
expect endsWith 0 "${run[@]}" --scene cornell --only "16^3" --seconds 0 --out "$work/times.json"
expect grep -q '"frames":\[{"name":"16^3, 64k rays",.*"fastest":"[a-z_]\+",.*"passes_minimum_ms":{"begin 0":[0-9]' "$work/times.json"
expect grep -q '"inject":"slices",.*"volume":{"median_ms":[0-9].*"picture":{"median_ms":[0-9]' "$work/times.json"

# A case that asks for more than can be: its last four bytes are the largest error that it allows.
printf '\0\0\0\0' | dd of="$work/pack/cases/whole_frame.case" bs=1 seek=$(($(stat -c %s "$work/pack/cases/whole_frame.case") - 4)) conv=notrunc status=none
expect endsWith 1 "${run[@]}" --check-only --out "$work/spoilt.json"
expect says "^FAIL  whole_frame (glsl"
expect grep -q '"passed":false' "$work/spoilt.json"

truncate -s -5 "$work/pack/cases/whole_frame.case"
expect endsWith 1 "${run[@]}" --check-only
expect says "whole_frame.case was not written by this version of clv_gpu_store"
rm "$work"/pack/cases/*.case
expect endsWith 1 "${run[@]}" --check-only
expect says "holds no cases"

expect endsWith 2 "${run[@]}" --no-such-option
expect endsWith 2 "$gpu"
expect endsWith 2 "$gpu" --device
expect endsWith 1 "$gpu" --pack "$work/no such folder"
expect says "holds no pack"
