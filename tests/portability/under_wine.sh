#!/usr/bin/env bash
# Runs a command with a wine of its own: it leaves the user's alone, and is gone when the command is. Where
# other work fills the machine wine may give up while it begins, so that it is tried three times, each in a
# folder that nothing is in yet.
# usage: under_wine.sh PREFIX-FOLDER COMMAND...
set -euo pipefail
folder=$1
shift
export WINEDEBUG=-all WINEDLLOVERRIDES="mscoree=;mshtml=" DISPLAY=""
log=$(mktemp)

stop_server() {
    wineserver -k >/dev/null 2>&1 </dev/null || true
}

# Wine's servers outlive it by some seconds and hold the output open, for which a test driver would wait. One
# that would end by itself may do so while the next program begins, whose connection is then reset: this one
# stays until it is killed.
trap 'stop_server; rm -f "$log"' EXIT

begin() {
    export WINEPREFIX=$folder/$1
    stop_server
    rm -rf "$WINEPREFIX"
    mkdir -p "$WINEPREFIX"
    wineserver -p && timeout 300 wineboot --init
}

begun=no
for try in 1 2 3; do
    status=0
    begin "$try" >"$log" 2>&1 </dev/null || status=$?
    if [ $status -eq 0 ]; then
        begun=yes
        break
    fi
    echo "Wine did not begin (exit code $status, try $try of 3)." >&2
    cat "$log" >&2
    stop_server
done
if [ $begun = no ]; then
    exit 1
fi

status=0
"$@" >"$log" 2>&1 </dev/null || status=$?
cat "$log"
exit $status
