"""The library in one place: theory over arrays of parameters, friction, simulations, extraction.

>>> from nucleation.api import critical_length
>>> critical_length(
...     shear_modulus=30e9, poisson_ratio=0.25, normal_stress=[50e6, 100e6],
...     a=0.010, b=0.015, slip_distance=5e-6,
... )
array([2.51327412, 1.25663706])

Plain numbers are in SI units. Functions of the linear theory take the parameters of
:class:`~nucleation.api.fault.Fault` as keywords, each a number, an array or a DataArray; arrays
broadcast as NumPy's do, DataArrays by the names of their dimensions; with a DataArray among the
parameters the result is a DataArray. A length that does not exist is NaN, and ``length_statuses``
has the reason: sliding is stable, the length exceeds the range of the search, or a formula is not
applicable.

Values with a unit are converted to SI units: a DataArray by its attribute ``units``, and pint
quantities, with quantities as results. A text is read as on the command line,
``slip_distance="0.5um"``, in simulations as in the theory.

Simulations, extraction and datasets are imported when first used, since that takes a while. They
need the extra ``solver``: without it a call raises an ImportError that names the extra.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..installed import MissingExtra, require, require_own
from ..lengths.in_use import lengths_in_use
from ..model.friction.law import Friction
from ..model.heterogeneity import Heterogeneity
from ..model.material import Material
from ..model.parameters import Geometry, Loading, Mesh, Parameters, Stepping
from ..model.perturbation import Perturbation
from ..model.quantities import ParameterError
from ..model.recording import Recording
from ..model.second_body import SecondBody
from ..theory.arrays import critical_length, critical_mode, spectrum, transfer_functions
from ..theory.critical import CriticalMode
from ..theory.status import NoLength
from .fault import Fault

if TYPE_CHECKING:
    from replication.configuration.samples import read_samples

    from ..datasets.netcdf import read, write
    from ..drop.drop_quantiles import drop_quantiles
    from ..drop.expected_drop import expected_drop
    from ..extraction.definitions import ExtractionSettings
    from ..extraction.extraction import extract
    from ..lengths.specimen import specimen_fit
    from ..lengths.specimen_quantiles import specimen_quantiles
    from ..lengths.status import length_statuses
    from ..lengths.uncertainty import length_quantiles
    from ..simulation.progress import simulate
    from ..simulation.run import run
    from ..theory.creep.lengths import stability_length
    from ..theory.creep.runaway import runaway_length
    from ..theory.weakening_patch import weakening_patch_length

__all__ = [
    "CriticalMode",
    "ExtractionSettings",
    "Fault",
    "Friction",
    "Geometry",
    "Heterogeneity",
    "Loading",
    "Material",
    "Mesh",
    "NoLength",
    "ParameterError",
    "Parameters",
    "Perturbation",
    "Recording",
    "SecondBody",
    "Stepping",
    "critical_length",
    "critical_mode",
    "drop_quantiles",
    "expected_drop",
    "extract",
    "length_quantiles",
    "length_statuses",
    "lengths_in_use",
    "read",
    "read_samples",
    "run",
    "runaway_length",
    "simulate",
    "specimen_fit",
    "specimen_quantiles",
    "spectrum",
    "stability_length",
    "transfer_functions",
    "weakening_patch_length",
    "write",
]


require_own()

_LATER = {
    "nucleation.extraction.definitions": ("ExtractionSettings",),
    "nucleation.extraction.extraction": ("extract",),
    "nucleation.simulation.progress": ("simulate",),
    "replication.configuration.samples": ("read_samples",),
    "nucleation.datasets.netcdf": ("read", "write"),
    "nucleation.drop.drop_quantiles": ("drop_quantiles",),
    "nucleation.drop.expected_drop": ("expected_drop",),
    "nucleation.simulation.run": ("run",),
    "nucleation.theory.creep.lengths": ("stability_length",),
    "nucleation.theory.creep.runaway": ("runaway_length",),
    "nucleation.theory.weakening_patch": ("weakening_patch_length",),
    "nucleation.lengths.specimen": ("specimen_fit",),
    "nucleation.lengths.specimen_quantiles": ("specimen_quantiles",),
    "nucleation.lengths.status": ("length_statuses",),
    "nucleation.lengths.uncertainty": ("length_quantiles",),
}
_MODULES = {name: module for module, names in _LATER.items() for name in names}

_EXTRAS = {
    **dict.fromkeys(("extract", "read", "run", "simulate", "write"), ("solver",)),
}
"""The extras of functions that need one."""


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        for extra in _EXTRAS.get(name, ()):
            require(extra)
    except MissingExtra as missing:
        return _without_extra(name, str(missing))
    return getattr(importlib.import_module(_MODULES[name]), name)


def _without_extra(name: str, message: str) -> Callable[..., Any]:
    """A substitute for a function without its extra; a call raises an error with the extra."""

    def unavailable(*_: Any, **__: Any) -> Any:
        raise MissingExtra(message)

    unavailable.__name__ = unavailable.__qualname__ = name
    unavailable.__doc__ = f"Not installed: {message}."
    return unavailable


def __dir__() -> list[str]:
    return __all__
