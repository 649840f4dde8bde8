#!/usr/bin/env bash
# Measures a GPU in one go: builds what that takes, compares the GPU with the CPU's stored results, times a frame's passes on it, and
# writes one JSON.
set -euo pipefail

usage() {
    cat <<'TEXT'
Usage: gpu.sh --write-pack DIR [--build DIR]
         On a machine with all packages: stores what a run needs in DIR, the cases, the scenes, the shaders' SPIR-V, and the headers of
         GLM and Vulkan.
       gpu.sh --pack DIR [--build DIR] [--bare] [--out FILE] [--device NAME] [--check-only] [--scene NAME] [--only TEXT] [--seconds S]
              [--every-cell]
         On a machine with a C++20 compiler, CMake and a Vulkan loader, with the same source: compares, measures, and writes FILE.
         --bare        take SPIR-V and headers from DIR, also where this machine has what makes them
         --device      index or a part of the name of the GPU
         --check-only  compare, and measure nothing
         --scene       that is timed: atrium (the default), two_rooms or cornell
         --only        time those settings whose name holds TEXT
         --seconds     that each timing is repeated, at least
         --every-cell  cells that no pixel reads hold light, too
FILE is gpu.json in the folder of the build, which is build/gpu, unless said otherwise. Ends with 1 where the GPU computes something else.
TEXT
}
fail() {
    echo "gpu.sh: $1" >&2
    exit "${2:-1}"
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
command="${0##*/} $*"
pack= write= build=$root/build/gpu out= bare=
runArguments=()
while (($# > 0)); do
    case $1 in
        --help | -h) usage && exit 0 ;;
        --bare) bare=1 ;;
        --check-only | --every-cell) runArguments+=("$1") ;;
        --pack | --write-pack | --build | --out | --device | --scene | --only | --seconds)
            (($# > 1)) || fail "a value must follow $1" 2
            case $1 in
                --pack) pack=$2 ;;
                --write-pack) write=$2 ;;
                --build) build=$2 ;;
                --out) out=$2 ;;
                *) runArguments+=("$1" "$2") ;;
            esac
            shift
            ;;
        *) usage >&2 && fail "there is no option $1" 2 ;;
    esac
    shift
done

# Of the source; a checkout that was changed says so.
commitOfSource() { git -C "$root" describe --always --dirty --abbrev=40 --exclude='*' 2>/dev/null || echo unknown; }

# Folder under which the compiler finds a header.
folderOf() {
    local file
    file=$("${CXX:-c++}" -std=c++20 -x c++ -M -include "$1" /dev/null | tr ' ' '\n' | grep "/$1\$") || fail "$1 was not found"
    echo "${file%%/"$1"*}"
}

configure() {
    local generator=()
    [[ -f $build/CMakeCache.txt ]] || ! command -v ninja >/dev/null || generator=(-G Ninja)
    cmake "${generator[@]}" -S "$root" -B "$build" "$@" >"$build.log" 2>&1 || fail "CMake fails: $(tail -n 3 "$build.log")"
}
compile() { cmake --build "$build" --parallel --target "$@" >>"$build.log" 2>&1 || fail "the build fails, see $build.log"; }

mkdir -p "$(dirname "$build")"
if [[ -n $write ]]; then
    [[ -f $build/CMakeCache.txt ]] || configure -DCMAKE_BUILD_TYPE=Release
    compile clv_gpu_store clv_shaders
    mkdir -p "$write/shaders" "$write/include"
    "$build/benchmarks/gpu_run/clv_gpu_store" "$write"
    cp "$build"/shaders/*.h "$write/shaders"
    glm=$(folderOf glm/glm.hpp) vulkan=$(folderOf vulkan/vulkan_raii.hpp)
    cp -RL "$glm/glm" "$vulkan"/{vulkan,vk_video} "$write/include"
    commitOfSource >"$write/commit"
    echo "wrote $write"
    exit 0
fi

[[ -n $pack ]] || { usage >&2 && fail "--pack DIR is missing; --write-pack makes one" 2; }
[[ -f $pack/commit ]] || fail "$pack holds no pack; --write-pack makes one"
pack=$(cd "$pack" && pwd)
commit=$(commitOfSource)
[[ $commit != unknown ]] || commit=$(<"$pack/commit")
[[ $commit == "$(<"$pack/commit")" ]] || echo "gpu.sh: the pack is of $(<"$pack/commit"), the source of $commit" >&2
settings=(-DCMAKE_BUILD_TYPE=Release -DCLV_BUILD_TOOLS=OFF -DCLV_BUILD_GPU_RUN=ON -DCLV_PREBUILT_SHADERS= "-DCLV_GLM_HEADERS=$pack/include" "-DVULKAN_HEADERS=$pack/include")
if [[ -n $bare ]] || ! command -v glslangValidator >/dev/null || ! command -v spirv-val >/dev/null; then
    settings+=("-DCLV_PREBUILT_SHADERS=$pack/shaders")
fi
if [[ -n $bare ]]; then
    for package in glm Vulkan embree TBB assimp OpenImageIO nlohmann_json fmt CLI11 GTest benchmark; do settings+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
fi
configure "${settings[@]}"
compile clv_gpu_run
exec "$build/benchmarks/gpu_run/clv_gpu_run" --pack "$pack" --out "${out:-$build/gpu.json}" --commit "$commit" --command "$command" "${runArguments[@]}"
