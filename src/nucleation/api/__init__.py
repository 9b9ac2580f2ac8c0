"""The library in one place: faults and their lengths, friction, simulations, extraction.

>>> from nucleation.api import Fault
>>> granite = Fault(
...     shear_modulus="30GPa", poisson_ratio=0.25, normal_stress=[50e6, 100e6],
...     a=0.010, b=0.015, slip_distance="5um",
... )
>>> granite.critical_length()
array([2.51327412, 1.25663706])

Plain numbers are in SI units. Every answer about a fault is a method of :class:`Fault`. Parameters
are numbers, arrays or DataArrays; arrays broadcast as NumPy's do, DataArrays by the names of their
dimensions; with a DataArray among the parameters the result is a DataArray. A length that does not
exist is NaN, and ``fault.lengths()`` has the reason: sliding is stable, the length exceeds the
range of the search, or a formula is not applicable.

Values with a unit are converted to SI units: a DataArray by its attribute ``units``, and pint
quantities, with quantities as results. A text is read as on the command line,
``slip_distance="0.5um"``, in simulations as in the theory.

Simulations, extraction and datasets are imported when first used, since that takes a while. They
need the extra ``solver``: without it a call raises an ImportError that names the extra.
"""

from __future__ import annotations

import importlib
import warnings
from typing import Any

from ..fault import PAPER, Fault
from ..installed import MissingExtra, require, require_own
from ..model.friction import Friction
from ..model.material import Material
from ..model.quantities import ParameterError
from ..model.settings import Perturbation
from ..theory.critical import CriticalMode
from ..theory.status import NoLength

_LATER = {
    "ExtractionSettings": "extraction.definitions",
    "Lengths": "answers.lengths",
    "Run": "run.run",
    "draw_samples": "lengths.draws",
    "extract": "extraction.extraction",
    "quantiles": "lengths.draws",
    "read": "datasets.netcdf",
    "simulate": "simulation.progress",
    "write": "datasets.netcdf",
}
"""Modules of names that are imported when they are first used."""

_OF_SOLVER = ("extract", "read", "simulate", "write")

__all__ = [
    "PAPER",
    "CriticalMode",
    "ExtractionSettings",
    "Fault",
    "Friction",
    "Lengths",
    "Material",
    "NoLength",
    "ParameterError",
    "Perturbation",
    "Run",
    "draw_samples",
    "extract",
    "quantiles",
    "read",
    "simulate",
    "write",
]

require_own()


def _simulate(self: Fault, *, progress: bool | None = None, **settings: Any) -> Any:
    """Simulate this fault, a single one with `velocity` and `friction`.

    Parameters
    ----------
    progress : bool, optional
        Whether a line shows how far the run is; by default on a terminal and in a notebook.
    **settings
        Of the run by name, in SI units: ``n_x``, ``perturbation``, ``block_length``, ... By default
        the block is 6 L_c long; half-spaces become blocks that are 4 L_c high and 35 L_c long,
        which changes L_s by 2 % or less.

    Returns
    -------
    Dataset
        The record, as of :func:`simulate`.

    Raises
    ------
    ParameterError
        If values contradict each other. A RunWarning warns of meshes, blocks and times that are
        unlikely to give the intended results, as `nucleation simulate` does.
    """
    require("solver")
    from ..run.advice import RunWarning, advice
    from ..run.checks import contradictions
    from ..run.run import Run
    from ..simulation.progress import simulate

    run = Run.sized(self, **settings)
    problems = list(contradictions(run))
    if problems:
        raise ParameterError("; ".join(problems))
    for topic, _, text in advice(run, run.critical_length):
        warnings.warn(f"{topic}: {text}", RunWarning, stacklevel=2)
    return simulate(run, progress=progress)


Fault.simulate = _simulate  # type: ignore[attr-defined]  # here, since a fault knows no simulation


def __getattr__(name: str) -> Any:
    if name in _LATER:
        try:
            if name in _OF_SOLVER:
                require("solver")
        except MissingExtra:
            return lambda *_, **__: require("solver")  # all names can be imported without it
        return getattr(importlib.import_module(f"..{_LATER[name]}", __name__), name)
    if name.endswith("_length") and hasattr(Fault, name):  # for scripts of earlier versions

        def length(**fault: Any) -> Any:
            text = f"{name}(**fault) is Fault(**fault).{name}()"
            warnings.warn(text, DeprecationWarning, stacklevel=2)
            return getattr(Fault(**fault), name)()

        return length
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
