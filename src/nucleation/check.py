"""Results that are stale, incomplete, damaged or foreign, found from the files themselves.

Snakemake knows what is out of date from its own notes, which stay behind when results are copied.
Every dataset carries its parameters, the digest of its code and those of the datasets it was made
from; every figure the digest of its code. Here they are held against the present configuration and
code. Nothing is run and nothing is changed.
"""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from PIL import Image, UnidentifiedImageError

from . import datasets
from .configuration import Configuration
from .datasets import DatasetError
from .figures.style import CODE
from .provenance import digest_now

LEFTOVERS = {
    ".*.tmp": "half a file of a run that was killed: delete it",
    "*.checkpoint.npz": "a run has begun here and goes on when it is asked for again",
    "*.failed.nc": "the record of a run that failed",
}


@dataclasses.dataclass(frozen=True)
class Finding:
    """A file that is not as it should be: `state` is stale, incomplete, damaged or foreign."""

    path: Path
    state: str
    reason: str

    def __str__(self) -> str:
        return f"{self.state:<10}  {self.path}: {self.reason}"


def check_results(settings: Configuration, directory: Path = Path()) -> list[Finding]:
    """All files below a configuration's results that are not what it would make now.

    Parameters
    ----------
    settings : Configuration
        The present one.
    directory : Path
        Where the workflow runs; the results lie below it.
    """
    results = directory / settings.results
    expected = _expected_parameters(settings)
    findings: list[Finding] = []
    for pattern, reason in LEFTOVERS.items():
        findings += [Finding(path, "incomplete", reason) for path in results.rglob(pattern)]
    for path in sorted(results.rglob("*.nc")):
        if not path.name.startswith(".") and not path.name.endswith(".failed.nc"):
            findings += _dataset_findings(path, path.relative_to(results), expected, directory)
    for path in sorted(results.glob("figures/*.png")):
        findings += _figure_findings(path)
    return findings


def _expected_parameters(settings: Configuration) -> dict[Path, Any]:
    """What the configuration makes datasets with, by path below the results."""
    expected: dict[Path, Any] = {Path("theory.nc"): settings.theory_parameters()}
    expected |= {
        Path("lengths", f"{study}.nc"): settings.lengths_parameters(study)
        for study in settings.studies
    }
    expected |= {
        Path("simulations", f"{run.id}.nc"): run.parameters.to_dict() for run in settings.runs
    }
    return {path: json.loads(json.dumps(value)) for path, value in expected.items()}


def _dataset_findings(
    path: Path, name: Path, expected: dict[Path, Any], directory: Path
) -> Iterator[Finding]:
    try:
        attributes = datasets.read(path).attrs
        parameters = json.loads(attributes["parameters"])
        sources = json.loads(attributes["sources"])
    except DatasetError as error:
        yield Finding(path, "damaged", str(error))
        return
    except KeyError as error:
        yield Finding(path, "foreign", f"it does not say where it is from: no attribute {error}")
        return
    if name in expected:
        changed = list(_differences(parameters, expected[name]))
        if changed:
            yield Finding(path, "stale", f"made with other parameters: {', '.join(changed[:3])}")
    elif name.parent.name in ("simulations", "lengths"):
        yield Finding(path, "foreign", "nothing in the configuration has this name")
    yield from _code_findings(path, attributes["code_digest"])
    for source, content in sources.items():
        try:
            now = datasets.attributes(directory / source).get("content")
        except DatasetError:
            yield Finding(path, "stale", f"it was made from {source}, which can't be read")
            continue
        if now != content:
            yield Finding(path, "stale", f"it was made from another {source}")


def _figure_findings(path: Path) -> Iterator[Finding]:
    try:
        with Image.open(path) as image:
            image.load()
            code = image.info.get(CODE)
    except (OSError, UnidentifiedImageError, SyntaxError, ValueError) as error:
        yield Finding(path, "damaged", str(error))
        return
    if code is not None:  # figures of other makers, such as the benchmark, carry none
        yield from _code_findings(path, code)


def _code_findings(path: Path, code: str) -> Iterator[Finding]:
    try:
        current = digest_now(code)
    except ValueError as error:
        yield Finding(path, "foreign", f"made by other code: {error}")
        return
    if current != code:
        yield Finding(path, "stale", f"the code of {code.split(' @ ')[0]} has changed")


def _differences(one: Any, other: Any, key: str = "") -> Iterator[str]:
    """Where two plain structures differ, as ``key = value (now value)``."""
    if isinstance(one, dict) and isinstance(other, dict) and one.keys() == other.keys():
        for name, value in one.items():
            yield from _differences(value, other[name], f"{key}.{name}".lstrip("."))
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for number, pair in enumerate(zip(one, other, strict=True)):
            yield from _differences(*pair, f"{key}[{number}]")
    elif one != other:
        if isinstance(one, dict | list) or isinstance(other, dict | list):
            yield f"{key or 'all'} differs"
        else:
            yield f"{key} = {one} (now {other})"
