"""The syntax tree of a module, without its words, and the imports in it."""

from __future__ import annotations

import ast
import hashlib
import sys
from typing import Any, NamedTuple

PACKAGES = ("nucleation", "replication")

_Import = tuple[int, str, str]  # level, module, name

_IGNORED_FIELDS = (
    "ctx",
    "kind",
    "type_comment",
    "type_ignores",
    "type_params",
)
"""Fields of syntax trees without meaning here, or unknown to some Python versions."""


class Source(NamedTuple):
    """A parsed file; the same for every Python version."""

    body: str  # digest of the syntax tree; imported names of the package are numbered by first use
    uses: list[_Import]  # imports of the package in that order
    libraries: list[str]  # roots of the other imports


def parse(content: bytes) -> Source:
    """Parse the bytes of a file.

    Raises
    ------
    SyntaxError
        If they are no Python.
    """
    tree = ast.parse(content)
    imports, libraries = _imports(tree)
    order: dict[str, int] = {}
    words: list[str] = []
    _write(tree, set(imports), order, words)
    unused = sorted(set(imports) - set(order), key=lambda name: imports[name])
    uses = [imports[name] for name in (*order, *unused)]
    body = hashlib.sha256("\0".join(words).encode()).hexdigest()
    return Source(body, uses, sorted(libraries))


def _imports(tree: ast.Module) -> tuple[dict[str, _Import], set[str]]:
    """Imports of the package by local name, and the roots of all other imports."""
    own: dict[str, _Import] = {}
    libraries: set[str] = set()
    waiting: list[ast.AST] = [tree]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Import):
            for alias in node.names:
                root = alias.name.split(".")[0]
                if root in PACKAGES:
                    own[alias.asname or alias.name] = (
                        0,
                        alias.name,
                        "",
                    )
                else:
                    libraries.add(root)
        elif isinstance(node, ast.ImportFrom) and _is_own(node):
            for alias in node.names:
                own[alias.asname or alias.name] = (
                    node.level,
                    node.module or "",
                    alias.name,
                )
        elif isinstance(node, ast.ImportFrom):
            libraries.add(str(node.module).split(".")[0])
        elif not _is_ignored(node):
            waiting += ast.iter_child_nodes(node)
    return own, libraries - {*sys.stdlib_module_names}


def _write(node: object, own: set[str], order: dict[str, int], words: list[str]) -> None:
    """Append a syntax tree, or a value in one, to a list of words."""
    if isinstance(node, list):
        words.append("[")
        for item in node:
            _write(item, own, order, words)
        words.append("]")
    elif isinstance(node, ast.Name) and node.id in own:
        number = order.setdefault(node.id, len(order))
        words.append(f"import {number}")
    elif isinstance(node, ast.AST):
        words.append(type(node).__name__)
        for field in node._fields:
            value = _counted(getattr(node, field, None))
            if field not in _IGNORED_FIELDS and value is not None and value != []:
                words.append(field)
                _write(value, own, order, words)
    else:
        words.append(repr(node))


def _counted(value: Any) -> Any:
    """The value of a field, a list without its ignored nodes."""
    if isinstance(value, list):
        return [item for item in value if not _is_ignored(item)]
    return value


def _is_ignored(node: object) -> bool:
    """Whether a node is a docstring, an import of the package or code for type checkers."""
    match node:
        case ast.ImportFrom():
            return _is_own(node) or node.module == "__future__"
        case ast.Import():
            return all(alias.name.split(".")[0] in PACKAGES for alias in node.names)
        case ast.If(test=ast.Name(id="TYPE_CHECKING")):
            return True
        case ast.Assign():
            return any(isinstance(t, ast.Name) and t.id == "__version__" for t in node.targets)
        case ast.Expr(value=ast.Constant(value=str())):
            return True
    return False


def _is_own(node: ast.ImportFrom) -> bool:
    return bool(node.level) or (node.module or "").split(".")[0] in PACKAGES
