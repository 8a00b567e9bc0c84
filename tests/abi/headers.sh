#!/usr/bin/env bash
# Every public header compiles alone, in every standard from C99 and C++98 on, without a single warning.
# usage: headers.sh INCLUDE-FOLDER COMPILER...
set -euo pipefail
include=$1
shift
strict="-pedantic-errors -Wall -Wextra -Wconversion -Wundef -Wshadow -Werror -fsyntax-only -I$include"
count=0
for compiler in "$@"; do
    for header in "$include"/lockstitch/*.h; do
        name=lockstitch/$(basename "$header")
        for standard in c99 c11 c2x; do
            $compiler -x c -std=$standard $strict -Wstrict-prototypes - <<<"#include <$name>"
            count=$((count + 1))
        done
        # C++98 has no <stdint.h> of its own; every compiler lends it C99's, with long long.
        for standard in c++98 c++11 c++20; do
            $compiler -x c++ -std=$standard $strict -Wno-long-long - <<<"#include <$name>"
            count=$((count + 1))
        done
    done
    # What is no integer would be cut to one without a word.
    for number in 'LKS_FIXED(2)' 'LKS_FIXED_RATIO(1, 2)'; do
        for language in c c++; do
            $compiler -x $language $strict - <<<"#include <lockstitch/fixed.h>
lks_fixed number = $number;"
            count=$((count + 1))
        done
    done
    for number in 'LKS_FIXED(0.5)' 'LKS_FIXED_RATIO(0.5, 2)' 'LKS_FIXED_RATIO(1, 2.0f)'; do
        for language in c c++; do
            if $compiler -x $language $strict - 2>/dev/null <<<"#include <lockstitch/fixed.h>
lks_fixed number = $number;"; then
                echo "$compiler takes $number as $language" >&2
                exit 1
            fi
        done
    done
done
[ "$count" -gt 0 ]
echo "$count compilations"
