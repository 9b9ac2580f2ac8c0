#!/bin/sh
# Starts Slurm with a controller and two virtual nodes of two cores on this machine, for tests.
#
#   tests/workflow/cluster/slurm/start.sh        then sinfo, sbatch, squeue, ... work;  tests/workflow/cluster/slurm/stop.sh
#
# Needs root or sudo, and the packages of `workflow/install-debian.sh cluster`. Starts only what
# does not run yet, so it also brings back a node whose daemon died. Refuses to touch a Slurm that
# it did not set up.
set -eu
. "$(dirname "$0")/common.sh"

for program in munged slurmctld slurmd scontrol; do
    command -v $program >/dev/null || die "no $program here: workflow/install-debian.sh cluster"
done
if [ -e "$CONFIG" ] && ! ours; then
    die "$CONFIG is not this script's: this machine belongs to a cluster already"
fi
if [ ! -e "$CONFIG" ] && sinfo >/dev/null 2>&1; then
    die "a Slurm that this script did not set up answers here"
fi

if ! munge --no-input 2>/dev/null | unmunge >/dev/null 2>&1; then
    install -d -m 0755 -o munge -g munge /run/munge
    [ -s /etc/munge/munge.key ] || mungekey --create
    setpriv --reuid munge --regid munge --init-groups munged
fi

if ! ours || ! daemon controller; then # never below a running controller
    mkdir -p "$(dirname "$CONFIG")" $STATE/controller
    memory=$(awk '/MemTotal/ { print int($2 / 2048) }' /proc/meminfo) # half of it, in MiB
    sed -e "s|@HOST@|$(hostname -s)|; s|@STATE@|$STATE|; s|@MEMORY@|$memory|" \
        "$(dirname "$0")/slurm.conf" >"$CONFIG"
    chmod 0644 "$CONFIG"
fi
daemon controller || slurmctld
for node in $NODES; do
    mkdir -p $STATE/$node
    daemon $node || slurmd -N $node
done

tries=0
until [ "$(sinfo --noheader --Node --states=idle,alloc,mix 2>/dev/null | wc -l)" -eq 2 ]; do
    tries=$((tries + 1))
    if [ $tries -gt 60 ]; then
        sinfo --Node --long >&2 || true
        die "the nodes did not come up in 30 s; their logs are in $STATE"
    fi
    sleep 0.5
done
