"""Results that are stale, incomplete, damaged or foreign, found from the files themselves.

Snakemake knows what is out of date from its own notes, which stay behind when results are copied.
Every dataset carries its parameters, the digest of its code and those of the datasets it was made
from; every figure the digest of its code. Here they are held against the present configuration and
code, and a dataset's table (CSV) against the dataset. Other files do not say where they are from:
:func:`unverified` names them. Nothing is run and nothing is changed.
"""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import xarray as xr
from PIL import Image, UnidentifiedImageError

from ..analysis import lengths
from ..configuration.load import Configuration
from ..datasets import netcdf
from ..datasets.provenance import digest_now
from ..datasets.variables import DatasetError
from ..figures.style import CODE
from ..verification import dispersion, orders

LEFTOVERS = {
    ".*.tmp": "half a file of a run that was killed: delete it",
    "*.checkpoint.npz": "a run has begun here and goes on when it is asked for again",
    "*.failed.nc": "the record of a run that failed",
}

UNREADABLE = (OSError, UnidentifiedImageError, SyntaxError, ValueError)
"""What Pillow raises for a damaged image."""

ORIGIN = ("parameters", "sources", "code_digest")
"""Attributes that tell where a dataset is from."""

WRITERS = {"verification.csv": orders.to_csv, "dispersion.csv": dispersion.to_csv}
"""What writes the tables that hold more than columns of their dataset."""

Origins = dict[Path, dict[str, Any]]
"""Attributes of all datasets opened in a check, by path; none of those that can't be read."""


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
    findings = [
        Finding(path, "incomplete", reason)
        for pattern, reason in LEFTOVERS.items()
        for path in _files(results, pattern)
    ]
    origins: Origins = {}
    for path in _files(results, "*.nc"):
        if not path.name.startswith(".") and not path.name.endswith(".failed.nc"):
            try:
                dataset = netcdf.read(path)
            except DatasetError as error:
                origins[path] = {}
                findings.append(Finding(path, "damaged", str(error)))
            else:
                origins[path] = dataset.attrs
                findings += _table_findings(path.with_suffix(".csv"), dataset)
    expected = _expected_parameters(settings)
    for path in [path for path, attributes in origins.items() if attributes]:
        findings += _dataset_findings(path, path.relative_to(results), expected, origins, directory)
    for path in sorted(results.glob("figures/*.png")):
        findings += _figure_findings(path)
    return findings


def _files(results: Path, pattern: str) -> list[Path]:
    """Files below the results but not below another configuration's, such as results/quick."""
    others = {path.parent for path in results.glob("*/simulations")}
    return [path for path in sorted(results.rglob(pattern)) if others.isdisjoint(path.parents)]


def unverified(settings: Configuration, directory: Path = Path()) -> list[Path]:
    """Files of the results that :func:`check_results`, with the same arguments, can't judge.

    They carry neither parameters nor the digest of their code: PDFs, verdicts, texts. Whether they
    are current is in Snakemake's notes alone.
    """
    results = directory / settings.results
    places = (results, results / "figures", results / "tables")
    files = [path for place in places for path in sorted(place.glob("[!.]*")) if path.is_file()]
    return [path for path in files if not _is_judged(path)]


def _is_judged(path: Path) -> bool:
    match path.suffix:
        case ".nc":
            return True
        case ".csv":
            return path.with_suffix(".nc").exists()
        case ".png":
            try:
                return _code_of(path) is not None
            except UNREADABLE:
                return True  # as damaged
        case _:
            return any(path.match(pattern) for pattern in LEFTOVERS)


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
    path: Path, name: Path, expected: dict[Path, Any], origins: Origins, directory: Path
) -> Iterator[Finding]:
    attributes = origins[path]
    lacking = [attribute for attribute in ORIGIN if attribute not in attributes]
    if lacking:
        reason = f"it does not say where it is from: no attribute {', '.join(lacking)}"
        yield Finding(path, "foreign", reason)
        return
    if name in expected:
        changed = list(_differences(json.loads(attributes["parameters"]), expected[name]))
        if changed:
            yield Finding(path, "stale", f"made with other parameters: {', '.join(changed[:3])}")
    elif name.parent.name in ("simulations", "lengths"):
        yield Finding(path, "foreign", "nothing in the configuration has this name")
    yield from _code_findings(path, attributes["code_digest"])
    for source, content in json.loads(attributes["sources"]).items():
        now = _attributes(directory / source, origins).get("content")
        if now is None:
            yield Finding(path, "stale", f"it was made from {source}, which can't be read")
        elif now != content:
            yield Finding(path, "stale", f"it was made from another {source}")


def _attributes(path: Path, origins: Origins) -> dict[str, Any]:
    """A dataset's attributes; the file is opened only if it was not before."""
    if path not in origins:
        try:
            origins[path] = netcdf.attributes(path)
        except DatasetError:
            origins[path] = {}
    return origins[path]


def _table_findings(path: Path, dataset: xr.Dataset) -> Iterator[Finding]:
    """Whether the table beside a dataset, if there is one, says what the dataset holds."""
    if not path.exists():
        return
    text = path.read_bytes().decode(errors="replace")
    columns = tuple(text.partition("\n")[0].split(","))
    try:
        same = text == WRITERS.get(path.name, lambda d: lengths.to_csv(d, columns))(dataset)
    except KeyError:  # other columns
        same = False
    if not same:
        yield Finding(path, "damaged", f"it does not hold what {path.with_suffix('.nc').name} does")


def _figure_findings(path: Path) -> Iterator[Finding]:
    try:
        code = _code_of(path)
    except UNREADABLE as error:
        yield Finding(path, "damaged", str(error))
        return
    if code is not None:  # figures of other makers, such as the benchmark, carry none
        yield from _code_findings(path, code)


def _code_of(path: Path) -> str | None:
    """The digest of the code that drew a figure; raises one of UNREADABLE if it is damaged."""
    with Image.open(path) as image:
        image.load()
        return image.info.get(CODE)


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
