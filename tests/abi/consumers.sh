#!/usr/bin/env bash
# Builds the same game outside the tree in every way that is promised, and compares what the games print.
# usage: consumers.sh PREFIX BUILD-FOLDER    PREFIX: where lockstitch is installed
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
prefix=$1
build=$2
rm -rf "$build"
mkdir -p "$build"

expected=""
compare() {  # NAME COMMAND...: the first one says what the others must say
    local name=$1 printed
    shift
    printed=$("$@")
    if [[ ! $printed =~ ^"tick 60 state "[0-9a-f]{16}$'\n'"tick 90 state "[0-9a-f]{16}$ ]]; then
        printf '%s printed something else:\n%s\n' "$name" "$printed" >&2
        exit 1
    fi
    expected=${expected:-$printed}
    if [ "$printed" != "$expected" ]; then
        printf '%s printed\n%s\ninstead of\n%s\n' "$name" "$printed" "$expected" >&2
        exit 1
    fi
    echo "ok: $name"
}

for language in c cpp; do
    cmake -S "$here/consumer_$language" -B "$build/$language" -G Ninja \
        -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
    cmake --build "$build/$language" >"$build/$language.log" || { cat "$build/$language.log" >&2; exit 1; }
    for form in static shared; do
        compare "find_package, $language, $form" "$build/$language/game_$form"
    done
done
if readelf -d "$build/c/game_static" | grep -q 'NEEDED.*libstdc++'; then
    echo "The C game is linked to libstdc++." >&2
    exit 1
fi

# The folder is moved first: nothing that was installed may know where it was.
moved=$build/moved
cp -a "$prefix" "$moved"
export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$moved" -name lockstitch.pc)")
flags=$(pkg-config --cflags --libs lockstitch)
library=$(pkg-config --variable=libdir lockstitch)
static=$(pkg-config --variable=static_library lockstitch)
strict="-pedantic -Wall -Wextra -Werror"
for compiler in cc clang; do
    # Word splitting is meant: flags are several arguments.
    $compiler -std=c99 $strict "$here/game.c" -o "$build/game_$compiler" $flags
    compare "pkg-config, c, shared, $compiler" env LD_LIBRARY_PATH="$library" "$build/game_$compiler"
    $compiler -std=c99 $strict "$here/game.c" -o "$build/game_static_$compiler" \
        $(pkg-config --cflags lockstitch) "$static"
    compare "pkg-config, c, static, $compiler" "$build/game_static_$compiler"
done
cc -std=c99 $strict "$here/game.c" -o "$build/game_all_static" \
    -static $(pkg-config --static --cflags --libs lockstitch)
compare "pkg-config, c, -static" "$build/game_all_static"
c++ -std=c++11 $strict "$here/game.cpp" -o "$build/game_cpp" $flags
compare "pkg-config, c++, shared" env LD_LIBRARY_PATH="$library" "$build/game_cpp"
compare "ctypes" python3 "$here/game.py" "$library/liblockstitch.so.0"

# The program that the README shows is the first thing that anybody copies.
sed -n '/^```c$/,/^```$/{/^```/d;p}' "$here/../../README.md" >"$build/readme.c"
cc -std=c99 $strict "$build/readme.c" -o "$build/readme" $flags
printed=$(LD_LIBRARY_PATH="$library" "$build/readme")
if [[ ! $printed =~ ^"tick 59 "[0-9a-f]{16}$ ]]; then
    printf 'The program in README.md printed: %s\n' "$printed" >&2
    exit 1
fi
echo "ok: the program in README.md"
