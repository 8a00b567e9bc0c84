#!/usr/bin/env bash
# clang-tidy over the SDK, with the checks of .clang-tidy as errors.
# usage: tidy.sh SOURCE-FOLDER BUILD-FOLDER    BUILD-FOLDER: holds compile_commands.json
set -euo pipefail
source=$(realpath "$1")
build=$2
export build

mapfile -t files < <(find "$source/sdk/src" -name '*.cpp' | sort)
[ ${#files[@]} -gt 0 ]
# One file a process, as many at once as there are processors; the count of suppressed warnings is noise.
printf '%s\0' "${files[@]}" |
    xargs -0 -n 1 -P "$(nproc)" sh -c 'clang-tidy --quiet -p "$build" "$0" 2>/dev/null'
echo "${#files[@]} files"
