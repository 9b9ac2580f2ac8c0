"""Install a file of pinned and hashed requirements into the environment that runs this script.

    python -P workflow/install.py environment.txt

uv takes a sixth of pip's time. It is used if it is there or pip can install it, with the settings
that pip has: indexes, links, constraints, certificates. If pip has a setting that uv lacks, or uv
fails, pip installs.
"""

import ast
import importlib
import os
import pkgutil
import shutil
import subprocess
import sys
from pathlib import Path

PIP = [sys.executable, "-m", "pip", "--disable-pip-version-check"]

OF_UV = {
    "index-url": "UV_DEFAULT_INDEX",
    "extra-index-url": "UV_INDEX",
    "find-links": "UV_FIND_LINKS",
    "constraint": "UV_CONSTRAINT",
    "cert": "SSL_CERT_FILE",
    "client-cert": "SSL_CLIENT_CERT",
    "proxy": "ALL_PROXY",
    "no-index": "UV_NO_INDEX",
    "timeout": "UV_HTTP_TIMEOUT",
    "trusted-host": "UV_INSECURE_HOST",
}
"""Variables of uv for settings of pip."""

ALIASES = {"default-timeout": "timeout", "pypi-url": "index-url"}

WITHOUT_EFFECT = (
    "cache-dir",
    "config-file",
    "disable-pip-version-check",
    "exists-action",
    "no-cache-dir",
    "no-color",
    "no-input",
    "progress-bar",
    "quiet",
    "require-virtualenv",
    "retries",
    "root-user-action",
    "user",
    "verbose",
)
"""Settings of pip that change nothing in an environment of pinned and hashed packages."""


def settings_of_pip() -> dict[str, str]:
    """All settings from pip's files and from the environment, which has precedence."""
    found: dict[str, dict[str, str]] = {"global": {}, "install": {}, ":env:": {}}
    listed = subprocess.run([*PIP, "config", "list"], capture_output=True, text=True, check=True)
    for line in listed.stdout.splitlines():
        name, _, value = line.partition("=")
        section, _, key = name.partition(".")
        if section in found:
            found[section][ALIASES.get(key, key)] = str(ast.literal_eval(value))
    return found["global"] | found["install"] | found[":env:"]


def variables_of_uv(settings: dict[str, str]) -> dict[str, str] | None:
    """The settings as variables of uv; None if it lacks one of them."""
    found = {"UV_INDEX_STRATEGY": "unsafe-best-match"}  # as pip; hashes make any index safe
    for key, value in settings.items():
        if key in WITHOUT_EFFECT:
            continue
        if key not in OF_UV:
            return None
        separator = "," if key == "find-links" else " "
        found[OF_UV[key]] = separator.join(value.split())
    return found


def uv() -> str | None:
    """The program, which pip installs if it is nowhere; None if that fails."""
    own = Path(sys.executable).with_name("uv")
    found = shutil.which("uv") or shutil.which(own)
    if found:
        return found
    pinned = Path(__file__).with_name("uv.txt")
    done = subprocess.run([*PIP, "install", "-qq", "--require-hashes", "-r", str(pinned)])
    return str(own) if done.returncode == 0 else None


def compile_imports(*packages: str) -> None:
    """Import all modules of packages, so that Python keeps bytecode of all that they load.

    uv makes no bytecode, and where PYTHONDONTWRITEBYTECODE is set each job would compile 1600
    modules again, for two seconds.
    """
    sys.dont_write_bytecode = False
    for name in packages:
        found = importlib.import_module(name)
        for module in pkgutil.walk_packages(getattr(found, "__path__", ()), name + "."):
            if not module.name.endswith("__main__"):
                importlib.import_module(module.name)
    importlib.import_module("numba").njit(lambda x: x)(1.0)  # a first call loads the rest of numba


def main(requirements: str) -> int:
    """Install; the exit status is that of uv or pip."""
    variables = variables_of_uv(settings_of_pip())
    program = uv() if variables is not None else None
    if program and variables is not None:
        given = os.environ | variables
        constraints = given.pop("UV_CONSTRAINT", "").split()  # of uv, only without hashes
        usual = ["--no-config", "--quiet", "--python", sys.executable]
        commands = [[program, "pip", "install", *usual, "--require-hashes", "-r", requirements]]
        if constraints:
            of_them = [word for file in constraints for word in ("--constraint", file)]
            checked = [program, "pip", "compile", *usual, "--no-deps", requirements, *of_them]
            commands.insert(0, [*checked, "--output-file", os.devnull])
        if all(subprocess.run(command, env=given).returncode == 0 for command in commands):
            return 0
        print("uv could not install; pip does", file=sys.stderr)
    command = [*PIP, "install", "--quiet", "--require-hashes", "-r", requirements]
    return subprocess.run(command).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
