#!/usr/bin/env bash
# Prints which share of the lines of capture_format the tests under sanitizers have run (./build.sh sanitize, which leaves the profiles).
# Fails below 95 %, and lists the lines that no test has run.
set -euo pipefail
cd "$(dirname "$0")/.."

least=95 profiles=build-sanitize/profiles program=build-sanitize/test_1_capture
llvm-profdata-16 merge -sparse -o $profiles/merged $profiles/*.profraw
llvm-cov-16 export -format=lcov -instr-profile=$profiles/merged $program capture_format >$profiles/lines
# lcov: SF:FILE, then DA:LINE,COUNT for each line with code.
awk -F'[:,]' -v root="$PWD/" -v least=$least '
    /^SF:/ { file = $2; sub(root, "", file); files[++n] = file }
    /^DA:/ { ++all[file]; ++lines; if ($3 > 0) ++ran; else { ++missed[file]; where[file] = where[file] " " $2 } }
    END {
        share = 100 * ran / lines
        printf "== line coverage of capture_format: %.1f %% (%d of %d lines)\n", share, ran, lines
        if (share >= least) exit 0
        printf "at least %d %% is asked for; lines that no test runs:\n", least
        for (i = 1; i <= n; ++i)
            if (missed[files[i]]) printf "%s (%d of %d):%s\n", files[i], missed[files[i]], all[files[i]], where[files[i]]
        exit 1
    }' $profiles/lines >&2
