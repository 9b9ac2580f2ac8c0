"""Quantiles of the length at the drop, of a fault whose parameters are uncertain."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.special import ndtri

from ..lengths.uncertainty import table_of_quantiles, with_never
from ..model.linearised import interface_state
from ..model.parameters import Parameters
from ..theory.creep.lengths import Patches, stability_point
from ..theory.critical import run_length
from ..theory.status import VALUE, NoLength
from .expected_drop import ExpectedDrop, expected_drop

if TYPE_CHECKING:
    import xarray as xr

TITLES = {
    "critical_length": "critical length L_c",
    "stability_length": "stability length L_s",
    "expected_length": "length at the drop L",
}
REASONS = 3  # that are named of those why draws lack a length
REALISATION = 1  # of the random numbers that choose a realisation in each draw


class _Answer(NamedTuple):
    length: float
    status: str
    reason: str = ""


def drop_quantiles(
    cases: Sequence[Parameters],
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
    lengths: Collection[str] = tuple(TITLES),
) -> xr.Dataset:
    """Quantiles of L_c, L_s and the length at the drop over many runs that differ.

    Parameters
    ----------
    cases : sequence of Parameters
        One for each draw of the uncertain parameters, with a declared perturbation.
    seed : int
        Where the random numbers start that choose one realisation of the perturbation in each draw.
    progress : callable, optional
        Called with the number of draws that are done and that of all. A draw takes about 2 s.
    lengths : collection of str
        Keys of the lengths to compute; without ``expected_length`` a draw takes 0.05 s.

    Returns
    -------
    Dataset
        ``value(key, quantile)`` (m), ``error(key, quantile)`` (m) and ``share(key)`` as of
        :func:`~nucleation.lengths.uncertainty.length_quantiles`, for ``critical_length``,
        ``stability_length`` and ``expected_length``. The last scatters by the realisation too. Its
        attribute ``doubtful`` is the number of draws whose drop should not be relied upon, and
        ``doubts`` has their reasons. ``why_not(key)`` is why some draws lack the length.

    Raises
    ------
    ParameterError
        If a run is no uniform fault that is pushed at its edge.

    Examples
    --------
    >>> from nucleation.api import Geometry, Parameters, Perturbation
    >>> parameters = Parameters(
    ...     geometry=Geometry(height=0.005, length=0.9),
    ...     perturbation=Perturbation(kind="normal_load", strength=1e-4),
    ... )
    >>> cases = [parameters, parameters.replaced({"slip_distance": 0.6e-6})]
    >>> found = drop_quantiles(cases, lengths=["critical_length"])
    >>> found["value"].shape
    (1, 5)
    """
    random = np.random.default_rng([seed, REALISATION])
    shares = (random.permutation(len(cases)) + 0.5) / len(cases)
    found: dict[str, list[_Answer]] = {key: [] for key in TITLES if key in lengths}
    doubts: list[str] = []
    for i, parameters in enumerate(cases):
        critical = _answer(_critical, parameters)
        if "critical_length" in found:
            found["critical_length"].append(critical)
        if "stability_length" in found:
            found["stability_length"].append(_answer(_stability, parameters, critical.length))
        if "expected_length" in found:
            found["expected_length"].append(_answer(_drop, parameters, shares[i], doubts))
        if progress is not None:
            progress(i + 1, len(cases))
    return _table(found, doubts, seed)


def _table(found: dict[str, list[_Answer]], doubts: list[str], seed: int) -> xr.Dataset:
    """The answers of all draws as quantiles."""
    counted, share, reasons = {}, [], []
    for key, answers in found.items():
        lengths = np.array([answer.length for answer in answers])
        counted[key] = with_never(lengths, np.array([answer.status for answer in answers]))
        share.append(np.isfinite(lengths).mean())
        known = dict.fromkeys(answer.reason for answer in answers if answer.reason)
        reasons.append("; ".join(list(known)[:REASONS]))
    attributes = {
        "draws": len(next(iter(found.values()))),
        "doubtful": len(doubts),
        "doubts": "; ".join(dict.fromkeys(doubts)),
        "seed": seed,
    }
    table = table_of_quantiles(counted, TITLES, share, attributes)
    return table.assign(why_not=("key", reasons, {"long_name": "why draws lack the length"}))


def _answer(length: Callable[..., float], *arguments: Any) -> _Answer:
    """The length (m) that a function has for some arguments, or why there is none."""
    try:
        return _Answer(length(*arguments), VALUE)
    except NoLength as none:
        return _Answer(np.nan, none.status, str(none))


def _critical(parameters: Parameters) -> float:
    return run_length(parameters, interface_state(parameters))


def _stability(parameters: Parameters, critical: float) -> float:
    return stability_point(Patches.of(parameters), critical).length


def _drop(parameters: Parameters, share: float, doubts: list[str]) -> float:
    """The length (m) at the drop of one realisation; why it is doubtful is added to the doubts."""
    drop = expected_drop(parameters)
    doubts += [drop.doubt] if drop.doubt else []
    return of_realisation(drop, share)


def of_realisation(found: ExpectedDrop, share: float) -> float:
    """The length (m) of the realisation below which a share of all realisations drops.

    Log-normal on either side of the median, with the law's 16 and 84 %. After slow slip it is
    uniform over the range about L_run in which the drop is expected.

    Parameters
    ----------
    found : ExpectedDrop
        The law's answer.
    share : float
        Between 0 and 1.
    """
    if found.slips_slowly:
        return found.low + share * (found.high - found.low)
    middle = np.log(found.length)
    end = found.low if share < 0.5 else found.high
    width = abs(np.log(end) - middle) / ndtri(0.84)
    return float(np.exp(middle + width * ndtri(share)))
