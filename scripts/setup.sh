# What demo.sh and test.sh share; sourced by bash.

# Debian packages that CMake asks for when it is given no options.
buildPackages=(
    cmake ninja-build g++
    libglm-dev
    libembree-dev libtbb-dev
    libassimp-dev zlib1g-dev                  # assimp's CMake package links zlib, but its Debian package does not bring it
    libopenimageio-dev openimageio-tools      # the same for OpenImageIO's tools, which its CMake package checks for
    libcli11-dev nlohmann-json3-dev libfmt-dev
    libvtk9-dev                               # plots of the report, volume files, the inspector
    libvulkan-dev glslang-tools spirv-tools   # the Vulkan back end and the shaders that it runs
    libgtest-dev libbenchmark-dev
)
# What the tests run beside that: compilers for every language that the shared headers are written in, and a display, a mouse and keys
# for the inspector.
testPackages=(clang-14 libclang-rt-14-dev mesa-vulkan-drivers vulkan-validationlayers spirv-cross xvfb xdotool)

# Installs those of the named packages that are missing, or says which they are and ends with 1.
installPackages() {
    local package log missing=() asRoot=()
    for package in "$@"; do
        dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
    done
    if ((${#missing[@]} == 0)); then return; fi

    echo "Installing Debian packages: ${missing[*]}"
    if ((EUID != 0)); then asRoot=(sudo); fi
    log=$(mktemp)
    # Without a network, apt-get update succeeds with a warning, and the installation fails.
    if ! { "${asRoot[@]}" apt-get -q update &&
           "${asRoot[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qy install --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
        echo "${0##*/}: cannot install these missing Debian packages (apt's own words: $log): ${missing[*]}" >&2
        exit 1
    fi
    rm "$log"
}

# Configures a preset of CMakePresets.json and builds the targets named after it, or all.
buildPreset() {
    local preset=$1
    shift
    CMAKE_GENERATOR=Ninja cmake --preset "$preset"
    cmake --build --preset "$preset" ${1:+--target "$@"}
}

# What benchmarks/report/stored_report.json was measured with.
storedReport=(--scenes cornell --methods clv ddgi thesis --points 300 --truth-samples 1024 --repeats 6)
