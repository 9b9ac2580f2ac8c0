"""What the source defines, by syntax trees and without importing it; what a text names."""

from __future__ import annotations

import ast
import importlib
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

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
def defined() -> dict[str, str]:
    """Every name of the package with its dots, and what it is.

    That is ``module``, ``class``, ``other``, or for an imported one where it comes from.
    """
    found: dict[str, str] = {}
    for path in FILES:
        place = place_of(path)
        found[place.removesuffix(".__init__")] = "module"
        package = tuple(place.split(".")[:-1])
        _define(tree(path).body, place.removesuffix(".__init__"), package, found)
    return found


def _define(body: list[ast.stmt], inside: str, package: tuple[str, ...], found: dict) -> None:
    for node in body:
        if isinstance(node, ast.ImportFrom):
            base = list(package[: len(package) - node.level + 1]) if node.level else []
            for alias in node.names:
                origin = ".".join([*base, *filter(None, [node.module]), alias.name])
                found.setdefault(f"{inside}.{alias.asname or alias.name}", origin)
        elif isinstance(node, ast.Import):
            for alias in node.names:
                own = alias.asname or alias.name.partition(".")[0]
                found.setdefault(f"{inside}.{own}", alias.name if alias.asname else own)
        elif isinstance(node, ast.ClassDef):
            found[f"{inside}.{node.name}"] = "class"
            for i, base in enumerate(node.bases):
                base = base.value if isinstance(base, ast.Subscript) else base
                found[f"{inside}.{node.name}.<{i}>"] = f"{inside}.{ast.unparse(base)}"
            _define(node.body, f"{inside}.{node.name}", package, found)
        elif isinstance(node, ast.FunctionDef):
            found[f"{inside}.{node.name}"] = "other"
            for inner in ast.walk(node) if found[inside] == "class" else ():  # of its objects
                if isinstance(inner, ast.Attribute) and isinstance(inner.ctx, ast.Store):
                    found.setdefault(f"{inside}.{inner.attr}", "other")
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                for name in ast.walk(target):
                    if isinstance(name, ast.Name):
                        found[f"{inside}.{name.id}"] = "other"
        elif isinstance(node, ast.If | ast.Try):  # names for types
            _define(node.body, inside, package, found)


def kind(name: str) -> str | None:
    """What a name with its dots is: ``module``, ``class``, ``other``, or None if there is none."""
    names = defined()
    if name in names:
        what = names[name]
        return what if what in ("module", "class", "other") else kind(what)
    before, _, last = name.rpartition(".")
    if not before:
        return None
    if before.partition(".")[0] not in ("nucleation", *ROOTS):
        return _elsewhere(name)
    if (origin := names.get(before)) not in (None, "module", "class", "other"):
        return kind(f"{origin}.{last}")
    bases = [names[base] for i in range(9) if (base := f"{before}.<{i}>") in names]
    return next((found for base in bases if (found := kind(f"{base}.{last}"))), None)


@cache
def _elsewhere(name: str) -> str | None:
    """The same of another package's."""
    module, _, last = name.rpartition(".")
    try:
        found = getattr(importlib.import_module(module), last)
    except (ImportError, AttributeError):
        return None
    return "class" if isinstance(found, type) else "other"


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


def imported(name: str) -> bool:
    """Whether a name goes by a module that has it from elsewhere."""
    parts, kinds = name.split("."), ("module", "class", "other")
    steps = (".".join(parts[:n]) for n in range(1, len(parts) + 1))
    return any(defined().get(step, "other") not in kinds for step in steps)


ROLE = re.compile(r"[:{]([a-z]+)[:}]`(?:[^`<]*<)?([\w.~]+)>?`")
WANTED = {"mod": "module", "class": "class", "exc": "class"}
OF_PYTHON = {*WANTED, "func", "meth", "attr", "data", "obj"}


def stale_roles(text: str, place: str = "") -> list[str]:
    """The roles in a text that name nothing, or something else than they say."""
    stale = []
    for role, target in ROLE.findall(text):
        kinds = [kind(name) for name in candidates(target, place)]
        right = any(found and WANTED.get(role, found) == found for found in kinds)
        if role in OF_PYTHON and (not right or imported(target.removeprefix("~"))):
            stale.append(f":{role}:`{target}`")
    return stale


def stale_dotted(text: str) -> list[str]:
    """The names of the package in a text, each with its dots, that are none."""
    named = re.findall(
        r"(?<![\w./-])nucleation(?!\.(?:sif|tar))(?:\.[A-Za-z_]\w*)+(?![\w*/])", text
    )
    return [name for name in named if not kind(name)]


FILE = re.compile(
    r"(?<![\w/.{}<>~:-])((?:[\w.-]+/)+[\w-][\w.-]*\.(?:py|smk|edp|html|js|css|md|rst|yaml|sh)"
    r"|\w+\.(?:py|smk|edp|js|css))\b(?![\w/*])"
)
"""A file with its folder, or the bare name of a source."""
