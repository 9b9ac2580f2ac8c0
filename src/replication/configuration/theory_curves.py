"""The theory's curve in the figure of a study that varies one number."""

from collections.abc import Iterable

import numpy as np

from nucleation.run.names import parameters

from .runs import StudyRun, varied
from .settings import Settings
from .studies import critical_lengths, fault_of

_CURVE_POINTS = 81
"""Values of the varied number."""

_Curve = dict[str, list[float]]


def theory_curves(
    runs: list[StudyRun],
    configuration: Settings,
) -> dict[str, _Curve]:
    """The theory's length over the one number that a study varies, closely spaced.

    Parameters
    ----------
    runs : list of StudyRun
        Runs of one study.
    configuration : Settings
        With the study.

    Returns
    -------
    dict
        By the words that differ among the runs (``"slip"``, or ``""``): the number (``x``) and
        the lengths (``length``, m; NaN where sliding is stable), to eight digits. Empty if the
        study varies several numbers or none, or an integer.
    """
    found = varied(runs)
    declared = parameters()
    words = [name for name in found if declared[name].choices]
    numbers = [name for name in found if name not in words]
    if len(numbers) != 1:
        return {}
    (name,) = numbers
    if declared[name].kind != "float":
        return {}

    values: dict[str, list[float]] = {}
    first_runs: dict[str, StudyRun] = {}
    for i, run in enumerate(runs):
        own_words = [str(found[word][i]) for word in words]
        kind = ", ".join(own_words)
        values.setdefault(kind, []).append(found[name][i])
        if name in run.given:
            first_runs.setdefault(kind, run)

    curves = {}
    for kind, run in first_runs.items():
        if len(values[kind]) < 2:
            continue
        x = _closely_spaced(values[kind])
        faults = []
        for value in x:
            given = {**run.given, name: value}
            _, theory = fault_of(run.study, given, configuration)
            faults.append(theory)
        lengths = critical_lengths(faults)
        curves[kind] = {
            "x": _rounded(x),
            "length": _rounded(lengths),
        }
    return curves


def _closely_spaced(values: list[float]) -> list[float]:
    """Numbers over the range of the values, on a logarithmic scale if all are positive."""
    low = min(values)
    high = max(values)
    spaced = np.geomspace if low > 0.0 else np.linspace
    numbers = spaced(low, high, _CURVE_POINTS)
    return numbers.tolist()


def _rounded(numbers: Iterable[float]) -> list[float]:
    texts = [f"{number:.8g}" for number in numbers]
    return [float(text) for text in texts]
