"""Source files as syntax trees without words, in which imports have no names."""

from __future__ import annotations

import ast
import hashlib
import sys
from typing import Any, NamedTuple

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
