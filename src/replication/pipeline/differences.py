"""Differences of two files of the same recipe."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from nucleation.datasets import netcdf

_OF_MACHINE = {
    "wall_seconds",
    "peak_megabytes",
    "created",
    "versions",
    "command",
    "history",
}
"""Variables that differ between any two results of one recipe."""


def differences(new: Path, old: Path) -> list[str]:
    """Describe the differences of two files, of datasets by variable.

    Parameters
    ----------
    new : Path
        File of the result that was made again.
    old : Path
        File in the store; it may be missing.

    Returns
    -------
    list of str
        Empty if they are the same.
    """
    if not old.is_file():
        return [f"{new.name} is not in the store"]
    if new.suffix != ".nc":
        same = new.read_bytes() == old.read_bytes()
        return [] if same else [f"{new.name} differs"]
    ours = netcdf.read(new)
    theirs = netcdf.read(old)
    names = {*map(str, ours.variables), *map(str, theirs.variables)}
    found = []
    for name in sorted(names - _OF_MACHINE):
        if name not in ours.variables or name not in theirs.variables:
            found.append(f"{name} is in one of them alone")
        elif not ours[name].variable.equals(theirs[name].variable):
            found.append(f"{name} differs{_size(ours[name].values, theirs[name].values)}")
    return found


def _size(ours: NDArray, theirs: NDArray) -> str:
    """The largest difference of two arrays over their largest value, in words."""
    if ours.shape != theirs.shape or ours.dtype.kind not in "fi":
        return ""
    largest = np.nanmax(np.abs(theirs), initial=0.0) or 1.0
    difference = np.nanmax(np.abs(ours - theirs), initial=0.0) / largest
    return f" by up to {difference:.1e} of its largest value"
