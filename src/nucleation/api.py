"""The library in one place: theory over arrays of parameters, friction, simulations, extraction.

>>> from nucleation.api import critical_length
>>> critical_length(
...     shear_modulus=30e9, poisson_ratio=0.25, normal_stress=[50e6, 100e6],
...     a=0.010, b=0.015, slip_distance=5e-6,
... )
array([2.51327412, 1.25663706])

All values are in SI units. Functions of the linear theory take the parameters of
:class:`~nucleation.theory.fault.Fault` as keywords, each a number, an array or a DataArray; arrays
broadcast as NumPy's do, DataArrays by the names of their dimensions, and what comes in as
DataArray goes out as one. Where homogeneous sliding is stable, lengths are NaN.

``run`` and ``simulate`` are imported when they are first used, since that takes seconds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .analysis.extraction import extract
from .datasets.netcdf import read, write
from .model.friction.law import Friction
from .model.material import Material
from .model.parameters import Geometry, Loading, Mesh, Parameters, Stepping
from .model.quantities import ParameterError
from .theory.arrays import (
    CriticalMode,
    critical_length,
    critical_mode,
    spectrum,
    transfer_functions,
)
from .theory.fault import Fault
from .theory.literature_table import lengths_in_use

if TYPE_CHECKING:
    from .simulation.run import run, simulate

__all__ = [
    "CriticalMode",
    "Fault",
    "Friction",
    "Geometry",
    "Loading",
    "Material",
    "Mesh",
    "ParameterError",
    "Parameters",
    "Stepping",
    "critical_length",
    "critical_mode",
    "extract",
    "lengths_in_use",
    "read",
    "run",
    "simulate",
    "spectrum",
    "transfer_functions",
    "write",
]


def __getattr__(name: str) -> Any:
    if name in ("run", "simulate"):
        from .simulation import run

        return getattr(run, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
