"""Uncertain parameters of a fault, and the quantiles of its lengths, for ``nucleation length``."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from replication.configuration.samples import read_samples

from ..lengths.draws import Range
from ..lengths.in_use import LENGTHS
from ..lengths.length import THIS_FAULT, TWO_MATERIALS
from ..lengths.uncertainty import QUANTILES, length_quantiles
from ..model.quantities import ParameterError
from ..theory.fault import FaultParameters
from ..types import Array
from . import DONE, STABLE
from .progress import progress_of
from .system_text import parameters_of, printed_warnings, system_of_fault, systems_of_lengths
from .text import Row, show, table, wrapped

if TYPE_CHECKING:
    import xarray as xr

QUANTILE_HEAD = ("quantiles (m)", *(f"{share:.0%}" for share in QUANTILES), "share")
QUANTILE_COLUMNS = range(1, len(QUANTILE_HEAD))
"""Columns of numbers in a table of quantiles."""

RowOfQuantiles = tuple[str, str, list[float], list[float], float]
"""Key, title, quantiles (m), their standard errors (m) and share of a length."""


def ranges_among(values: Mapping[str, Any]) -> dict[str, Any]:
    """The values that are ranges, by name."""
    return {name: value for name, value in values.items() if isinstance(value, Range)}


def take_uncertain(
    options: dict[str, Any],
    samples: Path | None,
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Separate the uncertain parameters from the options.

    Parameters
    ----------
    options : dict
        Values of the options for a fault, in SI units.
    samples : Path or None
        A file of samples.

    Returns
    -------
    medians : dict
        The options with medians in place of ranges and samples.
    uncertain : dict
        The ranges and samples, by name, with a, b and zeta for natural logarithms.

    Raises
    ------
    ParameterError
        If a parameter is given twice, or `a` is uncertain and neither zeta nor b is given.
    """
    uncertain = ranges_among(options)
    if samples is not None:
        columns = read_samples(samples)
        for name in columns:
            if options.get(name) is not None:
                raise ParameterError(f"{name} is given twice: as an option and in {samples}")
        uncertain |= columns
    medians = dict(options)
    for name, values in uncertain.items():
        medians[name] = float(np.median(values))
    given = any(medians.get(name) is not None for name in ("zeta", "b", "file"))
    if "a" in uncertain and not given:
        raise ParameterError("zeta or b is needed beside an uncertain a: the other one varies")
    if options["per_decade"]:
        for name in uncertain.keys() & {"a", "b", "zeta"}:
            uncertain[name] = _of_natural_logarithm(uncertain[name])
    return medians, uncertain


def _of_natural_logarithm(value: Range | Array) -> Range | Array:
    """A range or samples of a coefficient of log10, as a coefficient of the natural logarithm."""
    if not isinstance(value, Range):
        return value / math.log(10.0)
    ends = (value, value.low, value.high)
    return Range(*(end / math.log(10.0) for end in ends))


def varying(
    given: Mapping[str, Any],
    uncertain: Mapping[str, Any],
    options: Mapping[str, Any],
) -> dict[str, Any]:
    """The parameters of a median fault with its uncertain parameters in their place.

    Parameters
    ----------
    given : mapping
        The parameters of the median fault, in SI units.
    uncertain : mapping
        Its ranges and samples.
    options : mapping
        The options of the command. If b is among them, it is constant while a varies; if the second
        body is like the first, it varies with it.

    Returns
    -------
    dict
    """
    known = dict(given)
    if options["b"] is not None and "zeta" in known:
        known["b"] = known["a"] + known.pop("zeta")
    if options["second_body"] in (None, "same"):
        for name in ("shear_modulus", "poisson_ratio", "height"):
            second = f"second_{name}"
            if known.get(second) == known.get(name):
                known.pop(second, None)
    return {**known, **uncertain}


def print_quantiles(
    given: Mapping[str, Any],
    uncertain: Mapping[str, Any],
    options: Mapping[str, Any],
    papers: Sequence[str],
    as_json: bool,
) -> int:
    """Print the quantiles of all lengths of an uncertain fault.

    Parameters
    ----------
    given : mapping
        The parameters of the median fault, in SI units.
    uncertain : mapping
        Its ranges and samples.
    options : mapping
        The options of the command.
    papers : sequence of str
        The line about parameters that are the paper's, if there is one.
    as_json : bool
        Whether to print JSON.

    Returns
    -------
    int
        The exit code.
    """
    known = varying(given, uncertain, options)
    for name in ("weakening_rate", "draws"):
        known[name] = options[name]
    if "weakening_rate" in uncertain:
        known["weakening_rate"] = uncertain["weakening_rate"]
    with printed_warnings():
        middle = FaultParameters(**given)
        found = length_quantiles(progress=progress_of("draws"), **known)
    system = system_of_fault(middle, given, papers)
    names = list(uncertain)
    show(as_json, _described(system, found, middle, names), _lines(system, found, middle, names))
    return DONE if found["share"][0] > 0.0 else STABLE


def _described(
    system: list[str],
    found: xr.Dataset,
    middle: FaultParameters,
    uncertain: list[str],
) -> dict[str, Any]:
    """The quantiles for JSON, in SI units."""
    words = {length.key: length.words() for length in LENGTHS}
    lengths = []
    for key, _, values, errors, share in rows_of(found):
        numbers = {
            "key": key,
            "quantiles": by_quantile(values),
            "errors": by_quantile(errors),
            "share": share,
        }
        lengths.append(numbers | words.get(key, {"units": "m"}))
    return {
        "system": system,
        "parameters": parameters_of(middle),
        "uncertain": uncertain,
        **found.attrs,
        "lengths": lengths,
    }


def by_quantile(values: Iterable[Any]) -> dict[str, Any]:
    """Values in the order of the quantiles, as a mapping for JSON."""
    return {f"{q:g}": value for q, value in zip(QUANTILES, values, strict=True)}


def _lines(
    system: list[str],
    found: xr.Dataset,
    middle: FaultParameters,
    uncertain: list[str],
) -> list[str]:
    """The quantiles as a table."""
    rows: list[Row] = [QUANTILE_HEAD]
    system_by_key = {length.key: length.system for length in LENGTHS}
    nowhere = []
    for of_lengths in systems_of_lengths(middle, uncertain):
        of_system = []
        for row in rows_of(found):
            key, title, _, _, share = row
            if system_by_key.get(key, THIS_FAULT) != of_lengths:
                continue
            if share > 0.0:
                of_system.append(row_of_quantiles(row))
            else:
                note = " (two materials)" if of_lengths == TWO_MATERIALS else ""
                nowhere.append(f"{title}{note}")
        if of_system:
            rows += [f"for {of_lengths}:", *of_system]
    lines = wrapped(*system, "", _counts(found.attrs, uncertain), "")
    lines += table(rows, QUANTILE_COLUMNS)
    if nowhere:
        lines += wrapped("", f"without a value in any draw: {'; '.join(nowhere)}")
    remark = (
        "stable: no patch nucleates in the range of the search, which counts as an infinite "
        "length; digits by the number of draws. share: of the draws with this length; full lengths"
    )
    return [*lines, *wrapped("", remark)]


def _counts(count: Mapping[str, Any], uncertain: list[str]) -> str:
    """The numbers of draws, valid or not, in words."""
    text = f"{count['draws']} draws of {', '.join(uncertain)}: {count['invalid']} left out"
    if count["invalid"]:
        text += f" ({count['outside']} not allowed)"
    text += f", {count['stable']} of the others stable, without L_c"
    if count["beyond"]:
        text += f", {count['beyond']} with an L_s beyond 3 L_c"
    return text


def row_of_quantiles(row: RowOfQuantiles) -> Sequence[str]:
    """The cells of one row of a table of quantiles."""
    _, title, values, errors, share = row
    numbers = [as_sure(value, error) for value, error in zip(values, errors, strict=True)]
    return [title, *numbers, f"{share:.1%}"]


def as_sure(value: float, error: float) -> str:
    """A quantile with the digits that its standard error leaves, at most four.

    Parameters
    ----------
    value, error : float
        The quantile and its standard error, in the same unit.

    Returns
    -------
    str

    Examples
    --------
    >>> as_sure(2.8083, 0.04), as_sure(8.09, 0.6), as_sure(4.89012, 1e-5), as_sure(12.3, 20.0)
    ('2.81', '8.1', '4.890', '10')
    """
    if math.isinf(value):
        return "stable"
    if not (value > 0.0 and math.isfinite(error)):
        return f"{value:.1g}"
    size = math.floor(math.log10(value))
    digits = 4
    if error > 0.0:
        certain = size - math.floor(math.log10(error)) + 1
        digits = min(max(certain, 1), 4)
    if abs(size) > 4:
        return f"{value:.{digits - 1}e}"
    decimals = digits - 1 - size
    return f"{round(value, decimals):.{max(decimals, 0)}f}"


def rows_of(found: xr.Dataset) -> Iterable[RowOfQuantiles]:
    """The rows of a table of quantiles."""
    names = ("key", "title", "value", "error", "share")
    columns = [found[name].values.tolist() for name in names]
    return zip(*columns, strict=True)
