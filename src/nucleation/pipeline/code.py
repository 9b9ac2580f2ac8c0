"""What code a result depends on, by its content: no name of a module or file takes part.

The digest of a script or module is a hash of its syntax tree, without words (comments, docstrings,
layout), in which whatever it imports from the package is replaced by the digest of where that
comes from. So a change of any definition reaches all that use its module, directly or not, and a
module that is moved or renamed changes nothing. The versions of the libraries that this code
imports are part of it. docs/reuse.md says where the line is drawn.
"""

import contextlib
import hashlib
import importlib
import importlib.metadata
import json
from functools import cache
from pathlib import Path
from typing import Any

from ..datasets.files import replacing
from .syntax import PACKAGE, Source, parse

ROOT = Path(__file__).resolve().parents[1]

# the wing that surrounds computations and can't change what they compute: in no digest
NEUTRAL = f"{PACKAGE}.pipeline"
# libraries whose distribution has another name than what is imported
DISTRIBUTIONS = {"PIL": "pillow", "yaml": "pyyaml", "pypandoc": "pypandoc_binary"}
# libraries that do the work of others without being imported here
COMPANIONS = {"numba": ("llvmlite",), "xarray": ("netCDF4", "pandas"), "matplotlib": ("pillow",)}
# code that takes part in every dataset: how it is written
ALWAYS = (f"{PACKAGE}.datasets.netcdf",)
# what is kept of each source, by its content, so that a start of the workflow parses nothing
PARSED = ROOT / "__pycache__" / "digests.json"


class CodeError(RuntimeError):
    """Code that is not the one a job was planned with, or that can't be followed."""


@cache
def digest(*roots: str) -> str:
    """Digest of scripts and modules, of all they import from the package, and of libraries.

    `roots` are dotted names, such as ``nucleation.simulation.run``, or paths of scripts.

    Raises
    ------
    CodeError
        If a module is not there, or modules import each other in a circle.
    """
    parts = sorted(_fingerprint(_file(root)) for root in roots)
    found: set[str] = set()
    for path in closure(*roots):
        found |= _libraries(path)
    parts += [f"{name} {_version(name)}" for name in sorted(found)]
    _keep_parsed()
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


@cache
def closure(*roots: str) -> frozenset[Path]:
    """The files of `roots` and of all they import from the package, directly or not."""
    found: set[Path] = set()
    waiting = [_file(root) for root in roots]
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting += [place for place, _ in _imported(path)]
            waiting += _packages(path)
    return frozenset(found)


def forget() -> None:
    """Read all code anew at the next question: it may have been edited since the last one."""
    for function in (digest, closure, _source, _imported, _fingerprint):
        function.cache_clear()


def load(*roots: str) -> None:
    """Import all code of some roots, and read it anew at the next question.

    Code that is imported later as well is imported here: an edit after this can't reach the
    process any more, and one before it changes the digest.
    """
    for path in sorted(closure(*roots)):
        if path.is_relative_to(ROOT):
            importlib.import_module(_name(path))
    forget()


@cache
def _version(library: str) -> str:
    try:
        return importlib.metadata.version(library)
    except importlib.metadata.PackageNotFoundError:
        return "missing"  # here: the job that needs it says so


# -- syntax trees ----------------------------------------------------------------------------------


@cache
def _fingerprint(path: Path) -> str:
    """Digest of one file and of what it imports from the package."""
    parts = [_source(path).body]
    for place, name in _imported(path):
        parts.append(f"{_fingerprint(place)}:{name}")
    parts += [_fingerprint(package) for package in _packages(path)]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


@cache
def _source(path: Path) -> Source:
    content = path.read_bytes()
    return _parsed(path, hashlib.sha256(content).hexdigest(), content)


def _parsed(path: Path, name: str, content: bytes) -> Source:
    """A file's :class:`Source`, by the digest of its bytes: parsed once, and kept on the disk."""
    kept = _kept()
    if name not in kept:
        try:
            kept[name] = parse(content)
        except SyntaxError as error:
            raise CodeError(f"{path}:{error.lineno}: {error.msg}") from None
        kept["changed"] = True
    return Source(*kept[name])


def _keep_parsed() -> None:
    """Write what has been parsed since the last time."""
    kept = _kept()
    if kept.pop("changed", False):
        with contextlib.suppress(OSError), replacing(PARSED) as temporary:
            temporary.write_text(json.dumps(kept))


@cache
def _kept() -> dict[str, Any]:
    """What is on the disk; it is replaced as a whole, so it is right or not there."""
    try:
        return dict(json.loads(PARSED.read_text()))
    except (OSError, ValueError, TypeError):
        return {}


@cache
def _imported(path: Path) -> list[tuple[Path, str]]:
    """What a file imports from the package: files, and the names in them ("" for all of one)."""
    found = []
    for level, module, name in _source(path).uses:
        base = _base(path, level, module)
        if name and _exists(f"{base}.{name}"):
            base, name = f"{base}.{name}", ""
        if base != NEUTRAL and not base.startswith(f"{NEUTRAL}."):
            found.append((_file(base), name))
    return found


def _base(path: Path, level: int, module: str) -> str:
    """The dotted name that an import statement starts from."""
    if not level:
        return module
    parts = _name(path).split(".")
    package = parts if path.name == "__init__.py" else parts[:-1]
    return ".".join([*package[: len(package) - level + 1], *filter(None, [module])])


def _libraries(path: Path) -> set[str]:
    """Distributions that one file imports, and their companions."""
    roots = _source(path).libraries
    extra = {name for root in roots for name in COMPANIONS.get(root, ())}
    return {DISTRIBUTIONS.get(root, root) for root in roots} | extra


# -- files of the package --------------------------------------------------------------------------


def _packages(path: Path) -> list[Path]:
    """The ``__init__`` files that are executed before a module and hold more than words."""
    if not path.is_relative_to(ROOT):
        return []
    files = [parent / "__init__.py" for parent in path.parents if parent.is_relative_to(ROOT)]
    return [f for f in files if f != path and _source(f).body != parse(b"")[0]]


def _file(root: str) -> Path:
    """The file of a dotted name, or of a script given by its path."""
    if root.endswith(".py"):
        return Path(root).resolve()
    place = ROOT.joinpath(*root.split(".")[1:])
    for path in (place.with_suffix(".py"), place / "__init__.py"):
        if path.is_file():
            return path
    raise CodeError(f"{root} is no module of the package")


def _exists(module: str) -> bool:
    try:
        return bool(_file(module))
    except CodeError:
        return False


def _name(path: Path) -> str:
    """The dotted name of a file of the package."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join([PACKAGE, *(parts[:-1] if parts[-1] == "__init__" else parts)])
