#!/bin/sh
# Installs programs from Debian's archive that the optional parts of the workflow call.
#
#   workflow/install-debian.sh GROUP...        groups: browser cluster
#
# Needs root or sudo. Everything else the project needs is installed by make, in .venv.
set -eu

[ $# -gt 0 ] || set -- none
missing=
for group in "$@"; do
    case $group in
    browser) packages=chromium ;;
    cluster) packages="slurm-wlm munge" ;; # a batch system on one machine, for the tests
    *) echo "$0: no group $group; there are: browser cluster" >&2 && exit 2 ;;
    esac
    for package in $packages; do
        state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
        [ "$state" = installed ] || missing="$missing $package"
    done
done
[ -n "$missing" ] || exit 0
as_root=$([ "$(id -u)" -eq 0 ] || echo sudo)
# shellcheck disable=SC2086  # several packages, no sudo for root
$as_root apt-get update -qq
# shellcheck disable=SC2086
$as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends $missing
