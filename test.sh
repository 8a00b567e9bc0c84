#!/usr/bin/env bash
# Builds everything and runs all tests through ctest.
set -euo pipefail
cd "$(dirname "$0")"

usage() {
    cat <<'TEXT'
usage: ./test.sh [--portability] [--long] [-- CTEST-OPTIONS...]

Installs what is missing, builds into build/ and runs all tests: the SDK's own, the golden states and images,
programs outside the tree that link the installed library, and the checks of the sources. Two cores take eight
to 17 minutes.

  --portability  also clang, g++ without SIMD or floating-point registers, with -O0 and with -ffast-math,
                 address, undefined-behaviour and thread sanitizers, every scene on one to eight threads, and
                 the golden states on aarch64, 32-bit arm, s390x, Windows and WebAssembly, under qemu-user,
                 wine and node: 35 to 80 minutes
  --long         also the exhaustive sweeps, and with --portability g++ and clang at every -O, clang with
                 -ffast-math, g++ without SIMD, WebAssembly without SIMD, and as many samples of the wide
                 kernels under node and wine as here (under qemu as many as here without --long)
  --help         this text

  ./test.sh -- -L determinism      only the tests with this label
  ./test.sh -- -R '^unit\.'        only the tests whose name matches
TEXT
}

sets=(build render bench test)
portability=OFF
long=no
while [ $# -gt 0 ]; do
    case "$1" in
        --portability) portability=ON; sets+=(portability) ;;
        --long) export LOCKSTITCH_LONG=1; long=yes ;;
        --help | -h) usage; exit 0 ;;
        --) shift; break ;;
        *) echo "The option '$1' does not exist; ./test.sh --help lists them." >&2; exit 2 ;;
    esac
    shift
done

if [ "$portability$long" = ONyes ]; then
    portability=ALL
fi

scripts/dependencies.sh "${sets[@]}"
cmake --preset release -DLOCKSTITCH_TESTS=ON -DLOCKSTITCH_PORTABILITY="$portability" --log-level=WARNING
cmake --build build
exec ctest --test-dir build --output-on-failure --no-tests=error -j "$(nproc)" "$@"
