"""What code a result depends on, by its content: no name of a module or file takes part.

The digest of a module is a hash of its syntax tree, without words (comments, docstrings,
layout), in which whatever it imports from the package is replaced by the digest of where that
comes from. So a change of any definition reaches all that use its module, directly or not, and a
module that is moved or renamed changes nothing. The versions of the libraries that this code
imports are part of it.
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
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from ..datasets.files import replacing

PACKAGE = "nucleation"


class Source(NamedTuple):
    """What the words of one file come to; the same for every Python version."""

    body: str  # digest of its syntax tree, imported names of the package by their order of use
    uses: list[list[Any]]  # imports of the package in that order: level, module, name
    libraries: list[str]  # roots of the other imports


def parse(content: bytes) -> Source:
    """A file's :class:`Source`, from its bytes."""
    tree = ast.parse(content)
    imports, libraries = _imports(tree)
    order: dict[str, int] = {}
    words: list[str] = []
    _write(tree, set(imports), order, words)
    unused = sorted(set(imports) - set(order), key=lambda name: imports[name])
    uses = [list(imports[name]) for name in (*order, *unused)]
    return Source(hashlib.sha256("\0".join(words).encode()).hexdigest(), uses, sorted(libraries))


def _imports(tree: ast.Module) -> tuple[dict[str, tuple[int, str, str]], set[str]]:
    """Imports of the package, by the local name, and roots of all others."""
    own: dict[str, tuple[int, str, str]] = {}
    libraries: set[str] = set()
    waiting: list[ast.AST] = [tree]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name.split(".")[0] == PACKAGE:
                    own[alias.asname or alias.name] = (0, alias.name, "")
                else:
                    libraries.add(alias.name.split(".")[0])
        elif isinstance(node, ast.ImportFrom) and _is_own(node):
            for alias in node.names:
                own[alias.asname or alias.name] = (node.level, node.module or "", alias.name)
        elif isinstance(node, ast.ImportFrom):
            libraries.add(str(node.module).split(".")[0])
        elif not _is_dropped(node):
            waiting += ast.iter_child_nodes(node)
    return own, libraries - {*sys.stdlib_module_names}


def _write(node: Any, own: set[str], order: dict[str, int], words: list[str]) -> None:
    """Append a syntax tree to a list of words."""
    if isinstance(node, list):
        words.append("[")
        for item in node:
            _write(item, own, order, words)
        words.append("]")
    elif isinstance(node, ast.Name) and node.id in own:
        words.append(f"import {order.setdefault(node.id, len(order))}")
    elif isinstance(node, ast.AST):
        words.append(type(node).__name__)
        for field in node._fields:
            value = getattr(node, field, None)
            if isinstance(value, list):
                value = [item for item in value if not _is_dropped(item)]
            if field not in UNSAID and value is not None and value != []:
                words.append(field)
                _write(value, own, order, words)
    else:
        words.append(repr(node))


UNSAID = ("ctx", "kind", "type_comment", "type_ignores", "type_params")
"""Fields of syntax trees that say nothing or that not every Python version has."""


def _is_dropped(node: Any) -> bool:
    """Whether a node counts for nothing: words, imports of the package, hints for type checkers."""
    match node:
        case ast.ImportFrom():
            return _is_own(node) or node.module == "__future__"
        case ast.Import():
            return all(alias.name.split(".")[0] == PACKAGE for alias in node.names)
        case ast.If(test=ast.Name(id="TYPE_CHECKING")):
            return True
        case ast.Assign():
            return any(isinstance(t, ast.Name) and t.id == "__version__" for t in node.targets)
        case ast.Expr(value=ast.Constant(value=str())):
            return True
    return False


def _is_own(node: ast.ImportFrom) -> bool:
    return bool(node.level) or (node.module or "").split(".")[0] == PACKAGE


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
    """Digest of modules, of all they import from the package, and of libraries.

    `roots` are dotted names, such as ``nucleation.simulation.run``. A module that is not there
    raises a CodeError.
    """
    parts = sorted(map(_fingerprint, roots))
    parts += [f"{name} {_version(name)}" for name in sorted(libraries(*roots))]
    kept = _kept()
    if kept.pop("changed", False):
        with contextlib.suppress(OSError), replacing(PARSED) as temporary:
            temporary.write_text(json.dumps(kept))
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


@cache
def closure(*roots: str) -> frozenset[str]:
    """The modules `roots` and all they import from the package, directly or not."""
    found: set[str] = set()
    waiting = [*roots]
    while waiting:
        module = waiting.pop()
        if module not in found:
            found.add(module)
            waiting += [other for other, _ in _imported(module)]
            waiting += _packages(module)
    return frozenset(found)


def libraries(*roots: str) -> set[str]:
    """Distributions that some modules and all they import from the package need."""
    imported = {library for module in closure(*roots) for library in _source(module).libraries}
    companions = {name for library in imported for name in COMPANIONS.get(library, ())}
    return {DISTRIBUTIONS.get(library, library) for library in imported} | companions


def forget() -> None:
    """Read all code anew at the next question: it may have been edited since the last one."""
    for function in (digest, closure, _source, _imported, _fingerprint):
        function.cache_clear()


def load(*roots: str) -> None:
    """Import all code of some roots, and read it anew at the next question.

    Code that is imported later as well is imported here: an edit after this can't reach the
    process any more, and one before it changes the digest.
    """
    for module in sorted(closure(*roots)):
        importlib.import_module(module)
    forget()


@cache
def _version(library: str) -> str:
    try:
        return importlib.metadata.version(library)
    except importlib.metadata.PackageNotFoundError:
        return "missing"  # here: the job that needs it says so


@cache
def _fingerprint(module: str) -> str:
    """Digest of one module and of what it imports from the package."""
    parts = [_source(module).body]
    parts += [f"{_fingerprint(other)}:{name}" for other, name in _imported(module)]
    parts += [_fingerprint(package) for package in _packages(module)]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


@cache
def _source(module: str) -> Source:
    """A module's :class:`Source`: parsed once for its bytes, and kept on the disk."""
    path = _file(module)
    if path is None:
        raise CodeError(f"{module} is no module of the package")
    content = path.read_bytes()
    name, kept = hashlib.sha256(content).hexdigest(), _kept()
    if name not in kept:
        try:
            kept[name] = parse(content)
        except SyntaxError as error:
            raise CodeError(f"{path}:{error.lineno}: {error.msg}") from None
        kept["changed"] = True
    return Source(*kept[name])


@cache
def _kept() -> dict[str, Any]:
    """What is on the disk; it is replaced as a whole, so it is right or not there."""
    try:
        return dict(json.loads(PARSED.read_text()))
    except (OSError, ValueError, TypeError):
        return {}


@cache
def _imported(module: str) -> list[tuple[str, str]]:
    """What a module imports from the package: modules and names in them ("" for all of one)."""
    is_package = _file(module) == ROOT.joinpath(*module.split(".")[1:], "__init__.py")
    package = module if is_package else module.rpartition(".")[0]
    found = []
    for level, start, name in _source(module).uses:
        base = importlib.util.resolve_name("." * level + start, package)
        if name and _file(f"{base}.{name}"):
            base, name = f"{base}.{name}", ""
        if not f"{base}.".startswith(f"{NEUTRAL}."):
            found.append((base, name))
    return found


def _packages(module: str) -> list[str]:
    """The packages around a module whose ``__init__``, run before it, holds more than words."""
    parts = module.split(".")
    around = [".".join(parts[:depth]) for depth in range(len(parts) - 1, 0, -1)]
    return [package for package in around if _source(package).body != parse(b"").body]


def _file(module: str) -> Path | None:
    """The file of a dotted name, if there is one."""
    place = ROOT.joinpath(*module.split(".")[1:])
    files = (place.with_suffix(".py"), place / "__init__.py")
    return next((path for path in files if path.is_file()), None)
