# Shared by start.sh and stop.sh. (Munge's daemon is left running: it belongs to the machine.)
CONFIG=${1:-/etc/slurm/slurm.conf} # the default is where Debian's Slurm looks for it
STATE=/run/nucleation-slurm
NODES="n1 n2"
unset SLURM_CONF
PATH=$PATH:/usr/sbin:/sbin

die() {
    echo "$0: $1" >&2
    exit 1
}

# Whether the configuration is start.sh's.
ours() {
    head -n 1 "$CONFIG" 2>/dev/null | grep -q '^# nucleation: '
}

# Whether the daemon of this name runs. (A zombie has no command line any more.)
daemon() {
    [ -s "$STATE/$1.pid" ] && grep -q . "/proc/$(cat "$STATE/$1.pid")/cmdline" 2>/dev/null
}

if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || die "run it as root, or install sudo"
    exec sudo "$0" "$@"
fi
