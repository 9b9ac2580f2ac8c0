#!/bin/sh
# Prints the Pythons on this machine that the project runs on, newest first, one of each version.
#
# A name on the PATH need not work: shims of pyenv refuse a version that is not chosen, and Debian's
# python3 makes no environments without its python3-venv. So each is tried; pyenv's own come last.
for version in 3.13 3.12 3.11; do
    for candidate in "python$version" python3 python \
        "${PYENV_ROOT:-$HOME/.pyenv}/versions/$version".*/bin/python; do
        found=$("$candidate" -c "
import sys, ensurepip, venv
assert sys.implementation.name == 'cpython' and '%d.%d' % sys.version_info[:2] == '$version'
print(sys.executable)" 2>/dev/null) && echo "$found" && break
    done
done
