"""Of environment.txt what the workflow needs, without tests and documentation; printed.

python requirements.py pyproject.toml environment.txt

The lock file says of each package which ones ask for it ("via"), and of those that nothing else
asks for, the project itself: from pyproject.toml's lists it is known which of these are meant.
"""

import re
import sys
import tomllib
from pathlib import Path

EXTRAS = ("solver", "figures", "report", "workflow")
PROJECT = re.compile(r"nucleation(-length)?( \(pyproject\.toml\))?$")


def name_of(requirement: str) -> str:
    """The name in a requirement, as the lock file has it."""
    return re.split(r"[^\w.-]", requirement, maxsplit=1)[0].lower().replace("_", "-")


def blocks(lock: str) -> dict[str, list[str]]:
    """Requirements of the lock file by name; one may have several, for different machines."""
    found: dict[str, list[str]] = {}
    for block in re.split(r"^(?=[\w])", lock, flags=re.M):
        if not block.startswith("#"):
            found.setdefault(name_of(block), []).append(block)
    return found


def asked_by(block: str) -> set[str]:
    """Who asks for a package."""
    names = re.findall(r"^ +#(?: via)? +(\S.*)$", block.replace("# via\n", "#\n"), re.M)
    return {"" if PROJECT.match(name) else name_of(name) for name in names}


def needed(project: dict, lock: str) -> str:
    """The lock file without what only tests and documentation need."""
    lists = project["project"]
    extras = (lists["optional-dependencies"][extra] for extra in EXTRAS)
    asked = [*lists["dependencies"], *(name for extra in extras for name in extra)]
    chosen = {name_of(requirement) for requirement in asked} & blocks(lock).keys()
    known = {name: set().union(*map(asked_by, found)) for name, found in blocks(lock).items()}
    while more := {name for name, by in known.items() if by & chosen} - chosen:
        chosen |= more
    return "".join(b for name, found in blocks(lock).items() if name in chosen for b in found)


if __name__ == "__main__":
    print(needed(tomllib.loads(Path(sys.argv[1]).read_text()), Path(sys.argv[2]).read_text()))
