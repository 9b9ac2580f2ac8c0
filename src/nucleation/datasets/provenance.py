"""Where a result comes from: a digest of the code it depends on, versions, parameters.

The digest goes into the parameters of a workflow rule, so that Snakemake reruns exactly the jobs
whose code changed, and into the attributes of each dataset, so that a file can be judged alone.
"""

from __future__ import annotations

import ast
import datetime
import hashlib
import importlib.metadata
import json
import os
import platform
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

from .. import __version__
from ..datasets import netcdf

PACKAGE = "nucleation"
ROOT = Path(__file__).resolve().parent.parent
NUMERICAL_LIBRARIES = ("numpy", "scipy", "numba")


@cache
def digest(*modules: str, libraries: tuple[str, ...] = NUMERICAL_LIBRARIES) -> str:
    """Digest of modules of the package, of all they import from it, and of library versions.

    Comments, docstrings, formatting and the package's version do not count.

    Parameters
    ----------
    modules : str
        Dotted names, such as ``nucleation.simulation.run``.
    libraries : tuple of str
        Distributions whose installed version is part of the digest.

    Returns
    -------
    str
        ``modules @ libraries @ digest``, so that a dataset which carries it can be judged alone
        (:func:`digest_now`).
    """
    summary = hashlib.sha256()
    for name in sorted(closure(*modules)):
        summary.update(f"{name}\n{_code(name)}\n".encode())
    for library in libraries:
        summary.update(f"{library} {importlib.metadata.version(library)}\n".encode())
    return " @ ".join([" ".join(modules), " ".join(libraries), summary.hexdigest()])


def digest_now(text: str) -> str:
    """What :func:`digest` says today of the modules and libraries in an earlier result of it.

    Raises
    ------
    ValueError
        If the text is not of that form, or names modules that are no longer there.
    """
    modules, libraries, _ = text.split(" @ ")
    if not all(name.split(".")[0] == PACKAGE and _exists(name) for name in modules.split()):
        raise ValueError(f"modules that are not here: {modules}")
    return digest(*modules.split(), libraries=tuple(libraries.split()))


def closure(*modules: str) -> set[str]:
    """The modules of the package that `modules` import, directly or not, and themselves."""
    found: set[str] = set()
    waiting = list(modules)
    while waiting:
        name = waiting.pop()
        if name in found:
            continue
        found.add(name)
        waiting.extend(_imports(name))
        waiting.append(name.rpartition(".")[0] or PACKAGE)  # its package is executed first
    return found


def normalised(source: str) -> str:
    """Python source without comments, docstrings, formatting and ``__version__``."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(body, list):
            node.body = [s for s in body if not _is_text(s)] or [ast.Pass()]  # type: ignore[attr-defined]
    return ast.unparse(tree)


def _is_text(statement: ast.stmt) -> bool:
    """Whether a statement is a bare string (a docstring) or sets ``__version__``."""
    if isinstance(statement, ast.Assign):
        return any(isinstance(t, ast.Name) and t.id == "__version__" for t in statement.targets)
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )


@cache  # a workflow asks for many digests, most of them over the same modules
def _code(module: str) -> str:
    """One module's source, normalised."""
    return normalised(_source(module).read_text("utf-8"))


@cache
def _imports(module: str) -> set[str]:
    """The package's modules that one module names in its import statements."""
    source = _source(module)
    parts = module.split(".")
    package = parts if source.name == "__init__.py" else parts[:-1]
    named: set[str] = set()
    for node in ast.walk(ast.parse(source.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            named.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            start = package[: len(package) - node.level + 1] if node.level else []
            base = ".".join([*start, *filter(None, [node.module])])
            named.add(base)
            named.update(f"{base}.{alias.name}" for alias in node.names)
    return {name for name in named if name.split(".")[0] == PACKAGE and _exists(name)}


def _path(module: str) -> Path:
    return ROOT.joinpath(*module.split(".")[1:])


def _exists(module: str) -> bool:
    path = _path(module)
    return path.with_suffix(".py").is_file() or (path / "__init__.py").is_file()


def _source(module: str) -> Path:
    path = _path(module)
    if (path / "__init__.py").is_file():
        return path / "__init__.py"
    return path.with_suffix(".py")


def versions() -> dict[str, str]:
    """Versions of Python, of this package and of the libraries that results depend on."""
    libraries = (*NUMERICAL_LIBRARIES, "xarray", "netCDF4", "matplotlib", "snakemake")
    found = {library: importlib.metadata.version(library) for library in libraries}
    return {PACKAGE: __version__, "python": platform.python_version(), **found}


def fingerprint(parameters: Any, code_digest: str) -> str:
    """Digest of parameters (JSON-serialisable) and code, which tells whether a result is theirs."""
    text = json.dumps([parameters, code_digest], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def attributes(
    parameters: Any, code_digest: str, command: str, sources: Iterable[str] = ()
) -> dict[str, str]:
    """The attributes of a dataset that say how it was made (all of them text).

    Parameters
    ----------
    parameters : JSON-serialisable
        Everything from the configuration that the result depends on.
    code_digest : str
        From :func:`digest`.
    command : str
        A command that makes the dataset again.
    sources : iterable of path
        Datasets it is made from; their contents' digests are noted by path.
    """
    seconds = os.environ.get("SOURCE_DATE_EPOCH")
    moment = (
        datetime.datetime.fromtimestamp(int(seconds), datetime.UTC)
        if seconds
        else datetime.datetime.now(datetime.UTC)
    )
    return {
        "parameters": json.dumps(parameters, sort_keys=True),
        "code_digest": code_digest,
        "sources": json.dumps(contents(sources), sort_keys=True),
        "versions": json.dumps(versions(), sort_keys=True),
        "command": command,
        "created": moment.isoformat(timespec="seconds"),
    }


def contents(paths: Iterable[str]) -> dict[str, str]:
    """The digest of each dataset's content, by path."""
    return {str(path): str(netcdf.attributes(path)["content"]) for path in paths}
