"""The code that a result depends on, identified by content and not by names of modules or files.

The digest of a module is a hash of its syntax tree without comments, docstrings and layout. In
the tree, each name that is imported from the package is replaced by the digest of its module. So a
changed definition changes the digest of all modules that use it, directly or not, and moving or
renaming a module changes no digest. The versions of the imported libraries are included.
"""

from __future__ import annotations

import contextlib
import hashlib
import importlib
import importlib.metadata
import importlib.util
import json
from functools import cache
from pathlib import Path
from typing import Any

from nucleation.datasets.files import replacing

from .syntax import Source, parse

_ROOT = Path(__file__).resolve().parents[2]

# the wing around the computations can't change their results: it is in no digest
_NEUTRAL = "replication.pipeline"
# libraries whose distribution has another name than the module
_DISTRIBUTIONS = {
    "PIL": "pillow",
    "yaml": "pyyaml",
    "pypandoc": "pypandoc_binary",
}
# libraries that do the work of others and are not imported here
_COMPANIONS = {
    "numba": ("llvmlite",),
    "xarray": ("netCDF4", "pandas"),
    "matplotlib": ("pillow",),
}
ALWAYS = ("nucleation.datasets.netcdf",)
"""Code of every dataset: the writer of its file."""

_PARSED = _ROOT / "replication" / "__pycache__" / "digests.json"
"""Parsed sources by their content, so that a start of the workflow need not parse them again."""


class CodeError(RuntimeError):
    """Code differs from the code that a job was planned with, or can't be read."""


@cache
def digest(*roots: str) -> str:
    """Digest of modules, of all modules they import from the package, and of libraries.

    Parameters
    ----------
    *roots : str
        Dotted names, such as ``nucleation.simulation.run``.

    Returns
    -------
    str
        Hexadecimal digits.

    Raises
    ------
    CodeError
        If a module is missing or has a syntax error.
    """
    parts = sorted(map(_fingerprint, roots))
    parts += [f"{name} {_version(name)}" for name in sorted(libraries(*roots))]
    parsed = _parsed()
    if parsed.pop("changed", False):
        with (
            contextlib.suppress(OSError),
            replacing(_PARSED) as temporary,
        ):
            temporary.write_text(json.dumps(parsed))
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


@cache
def closure(*roots: str) -> frozenset[str]:
    """The modules `roots` and all modules they import from the package, directly or not."""
    found: set[str] = set()
    waiting = list(roots)
    while waiting:
        module = waiting.pop()
        if module not in found:
            found.add(module)
            waiting += [other for other, _ in _imported(module)]
            waiting += _packages(module)
    return frozenset(found)


def libraries(*roots: str) -> set[str]:
    """Distributions that modules need, and all modules they import from the package."""
    imported: set[str] = set()
    for module in closure(*roots):
        imported.update(_source(module).libraries)
    needed = {_DISTRIBUTIONS.get(library, library) for library in imported}
    for library in imported:
        needed.update(_COMPANIONS.get(library, ()))
    return needed


def forget() -> None:
    """Read all code anew at the next call: it may have been edited."""
    for function in (digest, closure, _source, _imported, _fingerprint):
        function.cache_clear()


def load(*roots: str) -> None:
    """Import all code of some roots, and read it anew for the next digest.

    A later edit can't reach this process any more, since code that is otherwise imported only when
    it is needed is imported here. An earlier edit changes the digest.
    """
    for module in sorted(closure(*roots)):
        importlib.import_module(module)
    forget()


@cache
def _version(library: str) -> str:
    try:
        return importlib.metadata.version(library)
    except importlib.metadata.PackageNotFoundError:
        return "missing"  # the job that needs it reports the error


@cache
def _fingerprint(module: str) -> str:
    """Digest of a module and of its imports from the package."""
    parts = [_source(module).body]
    parts += [f"{_fingerprint(other)}:{name}" for other, name in _imported(module)]
    parts += [_fingerprint(package) for package in _packages(module)]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


@cache
def _source(module: str) -> Source:
    """A parsed module; each content is parsed once and kept on the disk."""
    path = _file(module)
    if path is None:
        raise CodeError(f"{module} is no module of the package")
    content = path.read_bytes()
    name = hashlib.sha256(content).hexdigest()
    parsed = _parsed()
    if name not in parsed:
        try:
            parsed[name] = parse(content)
        except SyntaxError as error:
            raise CodeError(f"{path}:{error.lineno}: {error.msg}") from None
        parsed["changed"] = True
    return Source(*parsed[name])


@cache
def _parsed() -> dict[str, Any]:
    """The sources on the disk; the file is replaced as a whole, so it is complete or missing."""
    try:
        return dict(json.loads(_PARSED.read_text()))
    except (OSError, ValueError, TypeError):
        return {}


@cache
def _imported(module: str) -> list[tuple[str, str]]:
    """Imports of a module from the package: module and name ("" for a whole module)."""
    is_package = _file(module) == _ROOT.joinpath(*module.split("."), "__init__.py")
    package = module if is_package else module.rpartition(".")[0]
    found = []
    for level, start, name in _source(module).uses:
        base = importlib.util.resolve_name("." * level + start, package)
        if name and _file(f"{base}.{name}"):
            base = f"{base}.{name}"
            name = ""
        if not f"{base}.".startswith(f"{_NEUTRAL}."):
            found.append((base, name))
    return found


def _packages(module: str) -> list[str]:
    """The packages around a module with code in their ``__init__``, which runs before it."""
    parts = module.split(".")
    around = [".".join(parts[:depth]) for depth in range(len(parts) - 1, 0, -1)]
    empty = parse(b"").body
    return [package for package in around if _source(package).body != empty]


def _file(module: str) -> Path | None:
    """The file of a module; None if there is none."""
    place = _ROOT.joinpath(*module.split("."))
    for path in (place.with_suffix(".py"), place / "__init__.py"):
        if path.is_file():
            return path
    return None
