#!/bin/sh
# Stops the Slurm that start.sh started, with all its jobs, and removes its configuration.
set -eu
. "$(dirname "$0")/common.sh"

ours || exit 0
daemon controller && scancel --partition=main 2>/dev/null || true
for name in $NODES controller; do
    daemon $name && kill "$(cat $STATE/$name.pid)" || true
done
tries=0
for name in $NODES controller; do
    while daemon $name; do
        tries=$((tries + 1))
        [ $tries -le 60 ] || die "$name does not stop: process $(cat $STATE/$name.pid)"
        sleep 0.5
    done
done
rm -f "$CONFIG"
rm -rf $STATE
