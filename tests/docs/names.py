"""What there is of the source, and what its texts name."""

import ast
import contextlib
import importlib
import inspect
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import ModuleType

from docs.samples import ROOT

ROOTS = ("src", "benchmarks", "workflow", "docs")
FILES = [
    ROOT / "Snakefile",
    *(path for root in ROOTS for path in sorted((ROOT / root).rglob("*.py"))),
]
FILES += sorted((ROOT / "workflow").rglob("*.smk"))
"""Files whose docstrings and comments name things."""


def place_of(path: Path) -> str:
    """A module's name with its dots; outside of ``src`` that of its folders."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[parts[0] == "src" :])


@cache
def tree(path: Path) -> ast.Module:
    """The syntax of a module; rules have none of Python's."""
    return ast.parse(path.read_text(encoding="utf-8") if path.suffix == ".py" else "")


@cache
def exists(name: str) -> bool:
    """Whether a name with its dots is of anything."""
    found, rest = _module(name)
    for i, part in enumerate(rest):
        if isinstance(found, type) and i == len(rest) - 1 and not hasattr(found, part):
            return _is_of_objects(found, part)
        if not hasattr(found, part):
            return False
        found = getattr(found, part)
    return found is not None or bool(rest)


def _module(name: str) -> tuple[ModuleType | None, list[str]]:
    """The module in which a name is, and the parts after it."""
    parts = name.split(".")
    for n in range(len(parts), 0, -1):
        with contextlib.suppress(ImportError, TypeError, ValueError):  # a dot comes first
            return importlib.import_module(".".join(parts[:n])), parts[n:]
    return None, []


def _is_of_objects(owner: type, name: str) -> bool:
    """Whether the objects of a class have an attribute that the class itself has not."""
    own = [base for base in owner.__mro__ if base.__module__.startswith("nucleation")]
    return any(
        name in vars(base).get("__annotations__", {})
        or re.search(rf"self\.{name}\b[^=\n]*=", inspect.getsource(base))
        for base in own
    )


def words(path: Path) -> Iterator[tuple[str, str]]:
    """The docstrings and comments of a file.

    The former with the place where each stands, the dotted name of its module or class.
    """
    yield "\n".join(re.findall(r"#.*", path.read_text(encoding="utf-8"))), ""
    yield from _strings(tree(path), place_of(path).removesuffix(".__init__"))


def _strings(node: ast.AST, place: str) -> Iterator[tuple[str, str]]:
    for inner in ast.iter_child_nodes(node):
        if isinstance(inner, ast.Expr) and isinstance(inner.value, ast.Constant):
            yield str(inner.value.value), place
        elif isinstance(inner, ast.ClassDef):
            yield from _strings(inner, f"{place}.{inner.name}")
        elif isinstance(inner, ast.stmt):
            yield from _strings(inner, place)


def candidates(target: str, place: str) -> Iterator[str]:
    """The names that a role's target may stand for, at a place."""
    target = target.removeprefix("~")
    if not target.startswith("."):
        yield target
    while place:
        yield f"{place}.{target.removeprefix('.')}"
        place = place.rpartition(".")[0]


ROLE = re.compile(r"[:{]([a-z]+)[:}]`(?:[^`<]*<)?([\w.~]+)>?`")
OF_PYTHON = {"mod", "class", "exc", "func", "meth", "attr", "data", "obj"}


def stale_roles(text: str, place: str = "") -> list[str]:
    """The roles in a text that name nothing."""
    return [
        f":{role}:`{target}`"
        for role, target in ROLE.findall(text)
        if role in OF_PYTHON and not any(exists(name) for name in candidates(target, place))
    ]


def stale_dotted(text: str) -> list[str]:
    """The names of the package in a text, each with its dots, that are none."""
    named = re.findall(
        r"(?<![\w./-])nucleation(?!\.(?:sif|tar))(?:\.[A-Za-z_]\w*)+(?![\w*/])", text
    )
    return [name for name in named if not exists(name)]


FILE = re.compile(
    r"(?<![\w/.{}<>~:-])((?:[\w.-]+/)+[\w-][\w.-]*\.(?:py|smk|edp|html|js|css|md|rst|yaml|sh)"
    r"|\w+\.(?:py|smk|edp|js|css))\b(?![\w/*])"
)
"""A file with its folder, or the bare name of a source."""
