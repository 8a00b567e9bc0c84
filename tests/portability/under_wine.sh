#!/usr/bin/env bash
# Runs a command with a wine of its own: it leaves the user's alone, and is gone when the command is.
# usage: under_wine.sh PREFIX-FOLDER COMMAND...
set -euo pipefail
export WINEPREFIX=$1 WINEDEBUG=-all WINEDLLOVERRIDES="mscoree=;mshtml=" DISPLAY=""
shift

# Wine's servers outlive it by some seconds and hold the output open, for which a test driver would wait. One
# that would end by itself may do so while the next program begins, whose connection is then reset: this one
# stays until it is killed.
log=$(mktemp)
trap 'wineserver -k >/dev/null 2>&1 || true; rm -f "$log"' EXIT
mkdir -p "$WINEPREFIX"
wineserver -p >/dev/null 2>&1 </dev/null
wineboot --init >/dev/null 2>&1 </dev/null
status=0
"$@" >"$log" 2>&1 </dev/null || status=$?
cat "$log"
exit $status
