#!/usr/bin/env bash
# Compiles the SDK to WebAssembly, fetches Jolt Physics' package of WebAssembly into the build folder, and
# compares both under node.
# usage: bench/web/run.sh [--ticks N] [--side N] [--json]
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$root/build/web
jolt_version=1.1.0

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

quietly() {  # the output of what succeeds is of no interest
    "$@" >"$build/run.log" 2>&1 </dev/null || { tail -n 40 "$build/run.log" >&2; exit 1; }
}

mkdir -p "$build"
for target in wasm32 wasm32-simd128; do
    quietly cmake -S "$root/bench/web" -B "$build/$target" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/$target.cmake"
    quietly cmake --build "$build/$target"
done

jolt=$build/node_modules/jolt-physics
if ! grep -qs "\"version\": \"$jolt_version\"" "$jolt/package.json"; then
    quietly npm install --prefix "$build" --no-save --no-audit --no-fund --ignore-scripts \
        "jolt-physics@$jolt_version"
    # Its workers never start under node: a promise's member is read where that of its value is meant.
    threads='import("node:worker_threads")'
    sed -i "s/=await $threads\.workerData/=(await $threads).workerData/" \
        "$jolt/dist/jolt-physics.multithread.wasm.js"
fi
exec node "$root/bench/web/against_jolt.mjs" --build "$build" "$@"
