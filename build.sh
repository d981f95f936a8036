#!/usr/bin/env bash
# Builds Strata on Debian 12 and runs it. Installs what is missing with apt.
#   ./build.sh          set up and build build/strata
#   ./build.sh demo     record a scenario, replay it with several techniques, print error against time
#   ./build.sh test     build and run the whole test suite
#   ./build.sh fuzz     throw mutated bytes at every reader of files, 60 seconds each (or as many as: ./build.sh fuzz 600)
set -euo pipefail
cd "$(dirname "$0")"

packages=(
    g++ cmake ninja-build ccache pkg-config glslang-tools
    libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers
    libspirv-cross-c-shared-dev libfmt-dev libglm-dev libtbb-dev libzstd-dev libxxhash-dev
    libflatbuffers-dev flatbuffers-compiler libmeshoptimizer-dev libstb-dev
    libopenexr-dev libdeflate-dev nlohmann-json3-dev libcli11-dev
)
test_packages=(libgtest-dev libgmock-dev libbenchmark-dev clang-format)
fuzz_packages=(clang libclang-rt-14-dev)

say() { printf '== %s\n' "$*" >&2; }

# Installs the named packages that are not there yet.
install_missing() {
    local missing=()
    for package in "$@"; do
        dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return
    local root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { say "these packages are missing and there is no sudo to install them: ${missing[*]}"; exit 2; }
        root=(sudo)
    fi
    say "installing ${missing[*]}"
    "${root[@]}" apt-get update -qq
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# Configures a preset and builds targets: build PRESET [TARGET...].
build() {
    local preset=$1
    shift
    cmake --preset "$preset" >/dev/null
    cmake --build --preset "$preset" ${1:+--target "$@"}
}

demo() {
    local out=out/demo
    mkdir -p "$out"
    build/strata record smoke_grenade -o "$out/smoke.strata"
    build/strata info "$out/smoke.strata"
    for technique in $(build/strata list transparency --names); do
        build/strata replay "$out/smoke.strata" --use "$technique" -o "$out/${technique#*/}"
    done
    build/strata report "$out/smoke.strata" --stage transparency
    echo "images:"
    find "$out" -name '*.png' -o -name '*.exr' | sort
}

# Runs every fuzzer for some seconds on its corpus; what it finds stays in build-fuzz/found.
fuzz() {
    local seconds=$1
    for fuzzer in build-fuzz/*_fuzzer; do
        local name=${fuzzer##*/}
        name=${name%_fuzzer}
        mkdir -p "build-fuzz/new/$name" build-fuzz/found
        say "fuzzing $name for $seconds s"
        "$fuzzer" "build-fuzz/new/$name" "tests/fuzz/corpus/$name" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=3000 \
            -artifact_prefix="build-fuzz/found/$name-" -print_final_stats=1 >"build-fuzz/$name.log" 2>&1 ||
            { tail -40 "build-fuzz/$name.log" >&2; say "$name: see build-fuzz/found and build-fuzz/$name.log"; exit 1; }
        grep -E 'number_of_executed_units' "build-fuzz/$name.log"
    done
}

case "${1:-build}" in
    build)
        install_missing "${packages[@]}"
        build release strata
        say "built build/strata; try: build/strata help"
        ;;
    demo)
        install_missing "${packages[@]}"
        build release strata
        demo
        ;;
    test)
        install_missing "${packages[@]}" "${test_packages[@]}"
        build tests
        ctest --preset tests
        ;;
    fuzz)
        install_missing "${packages[@]}" "${fuzz_packages[@]}"
        build fuzz fuzzers
        fuzz "${2:-60}"
        ;;
    *)
        sed -n '2,7p' "$0" >&2
        exit 2
        ;;
esac
