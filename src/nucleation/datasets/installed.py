"""What is installed: which extra brings what, and whether the package is this project's own.

The library alone needs no more than ``dependencies`` in pyproject.toml. What needs an extra asks
for it here, so that whoever lacks it reads its name.
"""

import importlib.util
import sys

DISTRIBUTION = "nucleation-length"
"""The project's name for pip: ``nucleation`` is another project, with a package of that name."""

EXTRAS = {
    "solver": ("numba", "rocket_fft", "netCDF4", "pandas", "tqdm"),
    "figures": ("matplotlib", "PIL"),
    "report": ("jinja2", "markupsafe", "docutils"),
    "article": ("pypandoc", "typst"),
}
"""Modules that an extra brings."""

_OWN = "How long must a slipping patch of a frictional fault grow"


class MissingExtra(ModuleNotFoundError):
    """A library that belongs to an extra is not installed; the message names the extra."""


def require(extra: str) -> None:
    """Make sure of the modules of an extra.

    Raises
    ------
    MissingExtra
        Naming what is missing, and what to install.
    """
    missing = [name for name in EXTRAS[extra] if importlib.util.find_spec(name) is None]
    if missing:
        raise MissingExtra(
            f"this needs {', '.join(missing)}: pip install '{DISTRIBUTION}[{extra}]', or "
            f"'.[{extra}]' in a checkout"
        )


def require_own() -> None:
    """Make sure that ``nucleation`` is this package and not the other of that name.

    Raises
    ------
    ImportError
        Saying how to get rid of the other one.
    """
    package = sys.modules[__name__.partition(".")[0]]
    if package.__doc__ is not None and not package.__doc__.startswith(_OWN):
        raise ImportError(
            f"the package nucleation in {package.__file__} is not {DISTRIBUTION} but the project "
            "that is called nucleation on the package index: pip uninstall nucleation, then "
            f"pip install --force-reinstall {DISTRIBUTION}"
        )
