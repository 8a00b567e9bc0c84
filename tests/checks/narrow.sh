#!/usr/bin/env bash
# Reads the SDK as a 32-bit compiler does, with the SDK's own warnings as errors: a 64-bit number where a
# size is asked for is no warning on any other machine. It compiles nothing.
# usage: narrow.sh SOURCE-FOLDER BUILD-FOLDER COMPILER ARGUMENTS...
set -euo pipefail
source=$(realpath "$1")
build=$(realpath "$2")
shift 2
. "$(dirname "$0")/gathered.sh"

gather "$source/sdk/src" "$build/narrow"
mapfile -t files < <(find "$build/narrow" -name '*.cpp' | sort)
[ ${#files[@]} -gt 0 ]
# g++ tells of an interface that it passes otherwise since version 7, which is no warning of ours.
printf '%s\0' "${files[@]}" |
    xargs -0 -n 1 -P "$(nproc)" "$@" -std=c++20 -fsyntax-only -Werror -Wno-psabi -DLKS_BUILDING
echo "${#files[@]} files that include the SDK's sources"
