#!/usr/bin/env bash
# Configures and builds this tree once more in a folder of its own, without the renderer, and runs a command
# there.
# usage: nested.sh BUILD-FOLDER JOBS "TARGETS" [CMAKE-ARGUMENTS...] -- COMMAND...
set -euo pipefail
source=$(cd "$(dirname "$0")/../.." && pwd)
build=$1
jobs=$2
targets=$3
shift 3

arguments=()
while [ "$1" != -- ]; do
    arguments+=("$1")
    shift
done
shift

quietly() {  # the output of what succeeds is of no interest
    "$@" >"$build/nested.log" 2>&1 </dev/null || { tail -n 60 "$build/nested.log" >&2; exit 1; }
}

mkdir -p "$build"
quietly cmake -S "$source" -B "$build" -G Ninja -DLOCKSTITCH_RENDER=OFF -DLOCKSTITCH_BENCH=OFF \
    -DLOCKSTITCH_INSTALL=OFF -DLOCKSTITCH_NESTED_BUILDS=OFF -DLOCKSTITCH_PORTABILITY=OFF \
    "${arguments[@]}"
# Word splitting is meant: several targets.
quietly cmake --build "$build" --parallel "$jobs" --target $targets
# Exhaustive sweeps are for the native build: under an emulator or a sanitizer they would take hours. What
# foreign targets take instead they know from their build.
unset LOCKSTITCH_LONG
cd "$source"
exec "$@"
