#!/usr/bin/env bash
# Builds everything, draws every demo scene into out/, and checks each against its golden state.
set -euo pipefail
cd "$(dirname "$0")"

scripts/dependencies.sh build render
cmake --preset release -DLOCKSTITCH_TESTS=OFF --log-level=WARNING
cmake --build build

program=build/bin/lockstitch
"$program" render --all --out out
status=0
"$program" check || status=$?
echo "The pictures are in $PWD/out, one folder a scene."
exit "$status"
