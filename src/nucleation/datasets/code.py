"""The code that a result depends on: a digest of modules, of all that they import, of libraries.

Of a module the syntax tree counts, without comments, docstrings, layout and code for type checkers;
of a library its version. Code is read, not imported. What was found in a module is kept beside its
bytecode, with a digest of the module's bytes: parsing takes a tenth of a second in each job.
"""

from __future__ import annotations

import ast
import contextlib
import hashlib
import importlib
import importlib.metadata
import importlib.util
import json
import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import NamedTuple

from . import DatasetError

_OWN = __name__.partition(".")[0]
_ROOT = Path(__file__).resolve().parents[2]
_PARSER = Path(__file__).read_bytes()

# libraries whose distribution has another name than the module
_DISTRIBUTIONS = {"PIL": "pillow", "yaml": "pyyaml"}
# libraries that do the work of others and are not imported here
_COMPANIONS = {"numba": ("llvmlite",), "xarray": ("netCDF4", "pandas"), "matplotlib": ("pillow",)}
# fields of syntax trees without meaning here, or unknown to some Python versions
_UNCOUNTED = {"ctx", "kind", "type_comment", "type_ignores", "type_params"}


class Root(NamedTuple):
    """A module, by its dotted name, whose code counts with all that it imports and uses."""

    module: str
    unused: tuple[str, ...] = ()
    """Packages that it imports, directly or not, and never uses."""


ALWAYS = Root("nucleation.datasets.netcdf")
"""Code of every dataset: the writer of its file."""


class _Source(NamedTuple):
    tree: str  # digest of the syntax tree
    imports: list[tuple[int, str, str]]  # level, module, name


@cache
def digest(*roots: Root) -> str:
    """Digest of modules, of all that they import and use, and of libraries' versions."""
    parts = [f"{module} {_source(module).tree}" for module in sorted(closure(*roots))]
    parts += [f"{name} {_version(name)}" for name in sorted(libraries(*roots))]
    return _digest("\n".join(parts).encode())


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


@cache
def closure(*roots: Root) -> frozenset[str]:
    """Modules, all that they use of this library and of their own packages, and packages around."""
    packages = _packages(roots)
    found: set[str] = set()
    for root in roots:
        unused = tuple(f"{name}." for name in root.unused)
        own: set[str] = set()
        waiting = {root.module}
        while waiting:
            module = waiting.pop()
            own.add(module)
            needed = _needed(module, packages)
            waiting |= {name for name in needed if not f"{name}.".startswith(unused)} - own
        found |= own
    return frozenset(found)


def _packages(roots: Iterable[Root]) -> frozenset[str]:
    """The packages whose code is read; of all others the version counts."""
    return frozenset({_OWN, *(root.module.partition(".")[0] for root in roots)})


def libraries(*roots: Root) -> set[str]:
    """Distributions that modules and all that they import need."""
    known = _packages(roots) | sys.stdlib_module_names
    imports = [one for module in closure(*roots) for one in _source(module).imports]
    imported = {name.partition(".")[0] for level, name, _ in imports if not level} - known
    needed = {_DISTRIBUTIONS.get(name, name) for name in imported}
    return needed.union(*(_COMPANIONS.get(name, ()) for name in imported))


def forget() -> None:
    """Read all code anew at the next call: it may have been edited."""
    for function in (digest, closure, _source, _needed, _file):
        function.cache_clear()


def load(*roots: Root) -> None:
    """Import all code of some roots, and read it anew for the next digest.

    No later edit reaches this process, as nothing is left to import; an earlier one is noticed.
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
def _source(module: str) -> _Source:
    path = _file(module)
    if path is None:
        raise DatasetError(f"{module} is no module of the package")
    content = path.read_bytes()
    mark = _digest(_PARSER + content)
    kept = path.parent / "__pycache__" / f"{path.stem}.source.json"
    with contextlib.suppress(OSError, ValueError, TypeError):
        of, *found = json.loads(kept.read_bytes())
        if of == mark:
            return _Source(*found)
    source = _parsed(path, content)
    with contextlib.suppress(OSError):
        kept.write_text(json.dumps([mark, *source]))  # half of it is no JSON
    return source


@cache  # where it can't be kept, it is parsed once
def _parsed(path: Path, content: bytes) -> _Source:
    """A parsed module; the result is the same for every Python version."""
    try:
        tree = ast.parse(content)
    except SyntaxError as error:
        raise DatasetError(f"{path}:{error.lineno}: {error.msg}") from None
    imports: list[tuple[int, str, str]] = []
    words: list[str] = []
    _collect(tree, words, imports)
    return _Source(_digest("\0".join(words).encode()), imports)


@cache
def _needed(module: str, packages: frozenset[str]) -> list[str]:
    """The modules of some packages that one imports, and the packages around it."""
    parts = module.split(".")
    found = [".".join(parts[:depth]) for depth in range(1, len(parts))]
    is_package = _file(module) == _ROOT.joinpath(*parts, "__init__.py")
    base = module if is_package else found[-1]
    for level, start, name in _source(module).imports:
        if not level and start.partition(".")[0] not in packages:
            continue
        imported = importlib.util.resolve_name("." * level + start, base)
        inner = f"{imported}.{name}"
        found.append(inner if name and _file(inner) else imported)
    return found


@cache
def _file(module: str) -> Path | None:
    place = _ROOT.joinpath(*module.split("."))
    for path in (place.with_suffix(".py"), place / "__init__.py"):
        if path.is_file():
            return path
    return None


def _collect(node: object, words: list[str], imports: list[tuple[int, str, str]]) -> None:
    """Add the words of a syntax tree, or of a value in one, and its imports to two lists."""
    match node:
        case ast.If(test=ast.Name(id="TYPE_CHECKING")):
            return
        case ast.Assign(targets=[ast.Name(id="__version__")]):
            return
        case ast.Expr(value=ast.Constant(value=str())):  # a docstring
            return
        case ast.Import():
            imports += [(0, alias.name, "") for alias in node.names]
        case ast.ImportFrom():
            imports += [(node.level, node.module or "", alias.name) for alias in node.names]
    if isinstance(node, list):
        words.append("[")
        for item in node:
            _collect(item, words, imports)
        words.append("]")
    elif isinstance(node, ast.AST):
        words.append(type(node).__name__)
        for field, value in ast.iter_fields(node):
            if field not in _UNCOUNTED and value is not None:
                words.append(field)
                _collect(value, words, imports)
    else:
        words.append(repr(node))
