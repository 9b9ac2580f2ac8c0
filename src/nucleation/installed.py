"""The extras that bring optional libraries, and the check that the package is this project's.

The library alone needs only the ``dependencies`` in pyproject.toml. Code that needs an extra calls
:func:`require`, so that its user reads the name of the missing extra.
"""

import importlib.util
import sys

DISTRIBUTION = "nucleation-length"
"""The project's name for pip: ``nucleation`` is another project, with a package of that name."""

EXTRAS = {"solver": ("numba", "rocket_fft", "netCDF4", "pandas"), "figures": ("matplotlib",)}
"""Modules of each extra."""

ONE_CORE = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""They keep a simulation on one core: on several it is slower, and sums have another order."""

_OWN = "How long must a slipping patch of a frictional fault grow"


class MissingExtra(ModuleNotFoundError):
    """A library of an extra is not installed; the message names the extra."""


def require(extra: str) -> None:
    """Check that the modules of an extra are installed.

    Raises
    ------
    MissingExtra
        If one is missing; the message names it and the command that installs it.
    """
    missing = [name for name in EXTRAS[extra] if importlib.util.find_spec(name) is None]
    if missing:
        raise MissingExtra(
            f"this needs {', '.join(missing)}: pip install '{DISTRIBUTION}[{extra}]', or "
            f"'.[{extra}]' in a checkout"
        )


def require_own() -> None:
    """Check that ``nucleation`` is this package and not another project's of the same name.

    Raises
    ------
    ImportError
        If it is the other one; the message says how to remove it.
    """
    package = sys.modules[__name__.partition(".")[0]]
    if package.__doc__ is not None and not package.__doc__.startswith(_OWN):
        raise ImportError(
            f"the package nucleation in {package.__file__} is not {DISTRIBUTION} but the project "
            "that is called nucleation on the package index: pip uninstall nucleation, then "
            f"pip install --force-reinstall {DISTRIBUTION}"
        )
