#!/usr/bin/env bash
# The C and C++ sources are laid out as .clang-format says, and no line of any source is wider than 110
# columns.
# usage: format.sh SOURCE-FOLDER [--fix]
set -euo pipefail
cd "$1"
folders=(sdk render demos tests bench accuracy)

mapfile -t sources < <(find "${folders[@]}" -type f \( -name '*.h' -o -name '*.c' -o -name '*.cpp' \) | sort)
[ ${#sources[@]} -gt 0 ]
if [ "${2:-}" = --fix ]; then
    exec clang-format -i "${sources[@]}"
fi
status=0
clang-format --dry-run -Werror "${sources[@]}" || status=1

mapfile -t others < <(find . -path './build*' -prune -o -path ./out -prune -o -path ./.git -prune -o -type f \
    \( -name CMakeLists.txt -o -name '*.cmake' -o -name '*.sh' -o -name '*.py' -o -name '*.mjs' \) -print |
    sort)
# Columns, not bytes: grep counts characters where the locale is UTF-8.
if LC_ALL=C.UTF-8 grep -nE '^.{111,}' "${sources[@]}" "${others[@]}"; then
    echo "These lines are wider than 110 columns." >&2
    status=1
fi
[ $status -eq 0 ] && echo "${#sources[@]} sources and ${#others[@]} scripts"
exit $status
