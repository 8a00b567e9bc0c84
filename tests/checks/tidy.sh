#!/usr/bin/env bash
# clang-tidy over the SDK, with the checks of .clang-tidy as errors.
# usage: tidy.sh SOURCE-FOLDER BUILD-FOLDER ARGUMENTS...
#     BUILD-FOLDER holds compile_commands.json, for kernels; ARGUMENTS are the compiler's for all the others
set -euo pipefail
source=$(realpath "$1")
build=$(realpath "$2")
shift 2
. "$(dirname "$0")/gathered.sh"

# Kernels are compiled each with its own arguments. Precompiled headers are of another compiler.
tidy=$build/tidy
gather "$source/sdk/src" "$tidy"
rm "$tidy"/kernels_*.cpp
sed -E 's/ -Winvalid-pch//; s/ -include [^ ]*cmake_pch[^ ]*//' "$build/compile_commands.json" \
    >"$tidy/compile_commands.json"
mapfile -t kernels < <(find "$source/sdk/src/kernels" -name '*.cpp' | sort)
mapfile -t gathered < <(find "$tidy" -name '*.cpp' | sort)
[ ${#kernels[@]} -gt 0 ] && [ ${#gathered[@]} -gt 0 ]

check() {  # FILE ARGUMENTS...; the count of suppressed warnings is noise
    case "$1" in
        */src/kernels/*) clang-tidy --quiet --config-file="$config" -p "$tidy" "$1" ;;
        *)
            clang-tidy --quiet --config-file="$config" --checks=-bugprone-suspicious-include "$1" \
                -- -std=c++20 -DLKS_BUILDING "${@:2}"
            ;;
    esac 2>/dev/null
}
export -f check
export config=$source/.clang-tidy tidy
# One file a process, as many at once as there are processors.
printf '%s\0' "${kernels[@]}" "${gathered[@]}" |
    xargs -0 -P "$(nproc)" -I FILE bash -c 'check "$@"' bash FILE "$@"
echo "${#kernels[@]} kernels, ${#gathered[@]} files that include the others"
