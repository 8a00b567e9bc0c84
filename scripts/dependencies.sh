#!/usr/bin/env bash
# Installs what is missing of the packages that the named sets need; asks nothing, and does nothing when all
# is there.
# usage: scripts/dependencies.sh SET...    sets: build render bench test portability
set -euo pipefail

packages_of() {
    case "$1" in
        build) echo g++ cmake ninja-build pkg-config libxxhash-dev libcli11-dev ;;
        # No package depends on libgl1-mesa-dri, and without it there is no software driver.
        render)
            echo libglm-dev libstb-dev zlib1g-dev
            echo libegl-dev libgl-dev libegl1 libgl1-mesa-dri libosmesa6-dev
            ;;
        # Bullet as a peer, gnuplot for the report's plots.
        bench) echo libbenchmark-dev libbullet-dev gnuplot-nox valgrind ;;
        # Eigen for the reference solvers, a 32-bit compiler for its warnings.
        test)
            echo doctest-dev libeigen3-dev clang-format clang-tidy python3 binutils g++-arm-linux-gnueabihf
            ;;
        # mingw's -posix compiler: the other one has no std::thread.
        portability)
            echo g++-aarch64-linux-gnu g++-s390x-linux-gnu g++-mingw-w64-x86-64-posix
            echo clang qemu-user-static wine wine64 emscripten
            ;;
        *)
            echo "The package set '$1' does not exist; there are build, render, bench, test," \
                "portability." >&2
            return 2
            ;;
    esac
}

installed() {
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null || true)" = installed ]
}

wanted=""
for set in "$@"; do
    wanted+=" $(packages_of "$set")"
done
# Word splitting is meant: names of packages have no spaces.
wanted=$(echo $wanted)

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    if [ "${LOCKSTITCH_DEPENDENCIES:-}" = present ]; then
        exit 0
    fi
    echo "This system has no apt-get, so please install what corresponds to these Debian packages" \
        "and set LOCKSTITCH_DEPENDENCIES=present: $wanted." >&2
    exit 1
fi

missing=()
for package in $wanted; do
    installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
        echo "These packages are missing, and installing them needs root or sudo: ${missing[*]}." >&2
        exit 1
    fi
    as_root=(sudo)
fi

apt() {
    ${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive \
        apt-get -q -o DPkg::Lock::Timeout=300 "$@" </dev/null
}

echo "Installing: ${missing[*]}"
# The lists are fetched only where there are none, or too old ones.
if ! apt install -y --no-install-recommends "${missing[@]}"; then
    apt update
    if ! apt install -y --no-install-recommends "${missing[@]}"; then
        echo "apt-get could not install these packages: ${missing[*]}." >&2
        exit 1
    fi
fi
