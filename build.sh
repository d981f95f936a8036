#!/usr/bin/env bash
# Builds Strata on Debian 12 and runs it. Installs what is missing with apt.
#   ./build.sh          set up and build build/strata
#   ./build.sh demo     record a scenario, replay it with five techniques, print their errors against their times
#   ./build.sh test     build and run the tests; ./build.sh test all: also the whole product of techniques, scenarios and
#                       choices, and every mutant
#   ./build.sh format   check that clang-format would change no file
#   ./build.sh tidy     run clang-tidy on the lines that differ from the last landed commit, for at most 180 seconds; ./build.sh tidy 3600 for 3600
#   ./build.sh sanitize build with clang and run the tests of the capture format under address and undefined-behavior sanitizers, and print
#                       which of its lines they run; ./build.sh sanitize all: every test, and threads under theirs
#   ./build.sh fuzz     build the fuzzers with clang and run each for 60 seconds, all at once; ./build.sh fuzz 600 for 600
set -euo pipefail
cd "$(dirname "$0")"

packages=(
    g++ cmake ninja-build ccache pkg-config glslang-tools glslang-dev
    libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers
    libspirv-cross-c-shared-dev libfmt-dev libglm-dev libtbb-dev libzstd-dev libxxhash-dev
    libflatbuffers-dev flatbuffers-compiler libmeshoptimizer-dev libstb-dev
    libopenexr-dev libdeflate-dev nlohmann-json3-dev libcli11-dev
    libimgui-dev libglfw3-dev fonts-dejavu-core
)
test_packages=(libgtest-dev libgmock-dev libbenchmark-dev clang-format git xvfb xdotool x11-apps xclip libx11-dev chromium-common chromium-headless-shell libjemalloc2)
clang_packages=(clang-16 libclang-rt-16-dev llvm-16)
tidy_packages=(clang-16 clang-tidy-16)

usage() { sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2; }

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
    local out=out/demo techniques=(alpha_blend sorted_lists exact_function moments wavelet) technique
    mkdir -p "$out"
    build/strata record night_market --size 160x90 -o "$out/market.strata"
    build/strata info "$out/market.strata"
    for technique in "${techniques[@]}"; do
        build/strata replay "$out/market.strata" --use "transparency/$technique" -o "$out/$technique"
    done
    build/strata report "$out/market.strata" --stage transparency --techniques "$(IFS=,; echo "${techniques[*]}")"
    echo "all techniques of the stage at all their settings: build/strata report $out/market.strata --stage transparency"
    echo "images:"
    find "$out" -name '*.png' -o -name '*.exr' | sort
}

# Runs a fuzzer for some seconds on a copy of its corpus: fuzz NAME SECONDS; a finding fails, says what it is, and its input stays in out/fuzz.
fuzz() {
    local name=$1 seconds=$2 out=out/fuzz
    mkdir -p "$out/$name"
    cp -n tests/fuzz/corpus/"$name"/* "$out/$name"
    local options=(-max_total_time=$seconds -timeout=20 -rss_limit_mb=3000 -max_len=8192 -artifact_prefix="$out/$name-" -print_final_stats=1)
    [ ! -f "tests/fuzz/$name.dict" ] || options+=(-dict="tests/fuzz/$name.dict")
    say "fuzzing $name"
    if ! LLVM_PROFILE_FILE="$out/$name.profraw" "build-sanitize/${name}_fuzzer" "$out/$name" "${options[@]}" >"$out/$name.log" 2>&1; then
        tail -n 60 "$out/$name.log" >&2
        return 1
    fi
    grep -E 'number_of_executed_units' "$out/$name.log" >&2
}

# Runs one of two halves of a program's tests under sanitizers: run_half NAME 0|1.
run_half() {
    LLVM_PROFILE_FILE="build-sanitize/profiles/$1-%p%c.profraw" GTEST_TOTAL_SHARDS=2 GTEST_SHARD_INDEX=$2 "build-sanitize/$1" --gtest_brief=1
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
        case "${2:-}" in
            all)
                ctest --preset all
                tests/mutants/run.sh --tested
                ;;
            "") ctest --preset tests ;;
            *) usage ;;
        esac
        ;;
    format)
        install_missing clang-format git
        git ls-files '*.h' '*.cpp' | xargs -P "$(nproc)" -n 100 clang-format --dry-run -Werror
        ;;
    tidy)
        install_missing "${packages[@]}" "${test_packages[@]}" "${tidy_packages[@]}"
        tests/tidy.sh "${2:-180}"
        ;;
    sanitize)
        install_missing "${packages[@]}" "${test_packages[@]}" "${clang_packages[@]}"
        programs=(test_1_capture)
        case "${2:-}" in
            all) programs+=(test_2_graph test_4_references test_5_facts test_8_rules) ;;
            "") ;;
            *) usage ;;
        esac
        build sanitize "${programs[@]}"
        export -f run_half
        rm -rf build-sanitize/profiles
        for program in "${programs[@]}"; do
            say "$program under sanitizers"
            printf '0\n1\n' | xargs -P 2 -I HALF bash -euo pipefail -c "run_half $program HALF"
        done
        tests/line_coverage.sh
        if [ "${2:-}" = all ]; then
            say "programs with a device under sanitizers"
            build sanitize_device
            ctest --preset sanitize_device
            build threads test_threads
            say "test_threads under the thread sanitizer"
            # The disk that fills up and the killed writer are processes of their own, which the thread sanitizer does not follow.
            build-threads/test_threads --gtest_brief=1
        fi
        ;;
    fuzz)
        install_missing "${packages[@]}" "${test_packages[@]}" "${clang_packages[@]}"
        build sanitize fuzzers
        export -f fuzz say
        printf '%s\n' reader gltf deep | xargs -P 3 -I NAME bash -euo pipefail -c "fuzz NAME ${2:-60}"
        ;;
    *) usage ;;
esac
