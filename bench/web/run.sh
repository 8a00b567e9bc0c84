#!/usr/bin/env bash
# Compiles the SDK to WebAssembly, fetches the peers' packages of WebAssembly into the build folder, and
# compares them under node.
set -euo pipefail

usage() {
    cat <<'TEXT'
usage: bench/web/run.sh [cloth] [--ticks N] [--side N] [--json]
       bench/web/run.sh crowd [--ticks N] [--crowd block|pile] [--only TEXT] [--json]

Compiles the SDK to WebAssembly (some minutes, the first time), fetches Jolt Physics and Rapier from npm and
lets all take turns under node: one hanging cloth, or a crowd of falling humanoids.

  --ticks N    how many ticks of 1/60 s
  --side N     vertices along an edge of the cloth
  --crowd      block: 100 humanoids on a plane; pile: 30 in a pit
  --only TEXT  only the contenders whose names match, as a regular expression
  --json       as JSON
  --help       this text

  bench/web/run.sh
  bench/web/run.sh crowd --ticks 60 --only 'SIMD, 1 (sub)?step'
TEXT
}
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$root/build/web
packages=(jolt-physics@1.1.0
    @dimforge/rapier3d-simd-compat@0.20.0 @dimforge/rapier3d-deterministic-compat@0.21.0)

race=cloth
if [ "${1:-}" = cloth ] || [ "${1:-}" = crowd ]; then
    race=$1
    shift
fi
options=" $* "
if [[ "$options" == *" --help "* || "$options" == *" -h "* ]]; then
    usage
    exit 0
fi

demand() {  # command, what it belongs to
    command -v "$1" >/dev/null && return
    echo "This benchmark needs $2 ($1), which is not on this machine." >&2
    exit 1
}
demand emcc "emscripten, on Debian the package emscripten"
demand node "Node.js"
demand npm "Node's package manager"
demand cmake "CMake, on Debian the package cmake"
demand ninja "Ninja, on Debian the package ninja-build"
node "$root/bench/web/options.mjs" "$race" "$@"

quietly() {  # the output of what succeeds is of no interest
    "$@" >"$build/run.log" 2>&1 </dev/null || { tail -n 40 "$build/run.log" >&2; exit 1; }
}

mkdir -p "$build"
for target in wasm32 wasm32-simd128; do
    quietly cmake -S "$root/bench/web" -B "$build/$target" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/$target.cmake"
    quietly cmake --build "$build/$target"
done

installed() {
    local package
    for package in "${packages[@]}"; do
        grep -qs "\"version\": \"${package##*@}\"" "$build/node_modules/${package%@*}/package.json" ||
            return 1
    done
}
if ! installed; then
    quietly npm install --prefix "$build" --no-save --no-audit --no-fund --ignore-scripts "${packages[@]}"
    # Jolt's workers never start under node: a promise's member is read where that of its value is meant.
    threads='import("node:worker_threads")'
    sed -i "s/=await $threads\.workerData/=(await $threads).workerData/" \
        "$build/node_modules/jolt-physics/dist/jolt-physics.multithread.wasm.js"
fi
exec node "$root/bench/web/${race}_race.mjs" --build "$build" "$@"
