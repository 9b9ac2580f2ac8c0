#!/bin/sh
# Installs programs from Debian's archive that the optional parts of the workflow call.
#
#   workflow/install-debian.sh GROUP...        groups: browser cluster crosscheck
#
# Needs root or sudo. Everything else the project needs is installed by make, in .venv.
set -eu

packages=
for group in "$@"; do
    case $group in
    browser) packages="$packages chromium" ;;
    cluster) packages="$packages slurm-wlm munge" ;; # a batch system on one machine, for the tests
    crosscheck) packages="$packages freefem++ libfreefem++" ;; # MUMPS is in the library's package
    *)
        echo "$0: unknown group $group; known: browser cluster crosscheck" >&2
        exit 2
        ;;
    esac
done
if [ -z "$packages" ]; then
    echo "usage: $0 GROUP...   groups: browser cluster crosscheck" >&2
    exit 2
fi

if ! command -v apt-get >/dev/null; then
    echo "$0: no apt-get here: install by hand the equivalents of$packages" >&2
    exit 1
fi
missing=
for package in $packages; do
    state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$state" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
    as_root=sudo
    if ! command -v sudo >/dev/null; then
        echo "$0: run it as root, or install sudo: it has to install$missing" >&2
        exit 1
    fi
fi
# shellcheck disable=SC2086  # several packages, no sudo for root
$as_root apt-get update -qq
# shellcheck disable=SC2086
$as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends $missing
