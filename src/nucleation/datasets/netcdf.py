"""Datasets in netCDF files, written completely or not at all, with metadata for every variable."""

import contextlib
import os
import stat
from collections.abc import Hashable, Iterator
from typing import Any

import numpy as np
import xarray as xr

from . import DatasetError
from .files import replacing, require_room, seal, sealed
from .variables import require_annotated

CONVENTIONS = "CF-1.11"
"""The conventions that units, names and attributes follow (climate and forecast community)."""

TITLE = "Nucleation length of accelerating frictional slip"
_ROWS = "id"
"""The column that names the rows of a table; in a file it is their coordinate."""

_NOISY = ("slip_rate", "shear_stress")
"""Not compressed: their last digits are noise, so compression is slow and saves a quarter."""

_HEADERS = 2**20  # bytes of a file besides its values, at most


def write(dataset: xr.Dataset, path: str | os.PathLike[str], **attributes: Any) -> None:
    """Write a dataset, so that a crash leaves the whole file or none, and :func:`read` sees damage.

    Parameters
    ----------
    dataset : Dataset
        Each variable needs a long name, numbers need a unit.
    path : path
        The file; an older one is replaced.
    **attributes
        Further attributes of the dataset.

    Raises
    ------
    DatasetError
        If a variable lacks its unit or long name.
    OSError
        If the file can't be written.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> import xarray as xr
    >>> length = xr.DataArray(1.0, attrs={"units": "m", "long_name": "critical length"})
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "length.nc"
    ...     write(length.to_dataset(name="length"), path)
    ...     float(read(path)["length"])
    1.0
    """
    require_annotated(dataset)
    # an encoding from an earlier file may not fit: it would cut texts to the length they had there
    complete = dataset.drop_encoding().assign_attrs(attributes)
    attrs = complete.attrs
    attrs["Conventions"] = CONVENTIONS
    attrs.setdefault("title", TITLE)
    if {"created", "command"} <= attrs.keys():
        attrs["history"] = f"{attrs['created']}: {attrs['command']}"
    if _ROWS in complete and complete[_ROWS].ndim == 1:
        complete = complete.set_coords(_ROWS)
    encoding: dict[Hashable, dict[str, Any]] = {
        name: {"_FillValue": None} for name in complete.coords
    }
    for name, variable in complete.variables.items():
        if variable.dtype.kind in "fiu" and variable.ndim > 0 and name not in _NOISY:
            smaller = {"zlib": True, "complevel": 1, "shuffle": True}
            encoding.setdefault(name, {}).update(smaller)
    with replacing(path) as temporary:
        try:
            complete.to_netcdf(temporary, engine="netcdf4", encoding=encoding)
            seal(temporary, {str(name): np.asarray(x).tolist() for name, x in attrs.items()})
        except (OSError, RuntimeError):  # "NetCDF: HDF error", for a full disk and all else
            require_room(temporary, complete.nbytes + _HEADERS)
            raise


def read(path: str | os.PathLike[str], checked: bool = False) -> xr.Dataset:
    """Read a dataset into memory and check it.

    Parameters
    ----------
    path : path
        The file.
    checked : bool
        Whether its bytes were compared just now with those that were written.

    Returns
    -------
    Dataset
        The dataset as it was written, with the attributes that :func:`write` added.

    Raises
    ------
    DatasetError
        If the file is missing, truncated or damaged.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> import xarray as xr
    >>> length = xr.DataArray(1.0, attrs={"units": "m", "long_name": "critical length"})
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "length.nc"
    ...     write(length.to_dataset(name="length"), path)
    ...     float(read(path)["length"])
    1.0
    """
    with _refusing(path):
        sealed(path, whole=not checked)  # before HDF5 reads any byte
        # xarray would move the coordinate of the rows behind all columns
        with xr.open_dataset(
            path, engine="netcdf4", decode_times=False, decode_coords=False
        ) as stored:
            dataset = stored.load()
        declared = dataset.attrs.pop("coordinates", "").split()
        for variable in dataset.variables.values():
            declared += variable.attrs.pop("coordinates", "").split()
        return dataset.set_coords(sorted(set(declared) - {_ROWS}))


def attributes(path: str | os.PathLike[str]) -> dict[str, Any]:
    """The attributes of a dataset from its seal; its values are not checked.

    Raises a DatasetError if the file is missing or can't be read.
    """
    with _refusing(path):
        return sealed(path, whole=False)


@contextlib.contextmanager
def _refusing(path: str | os.PathLike[str]) -> Iterator[None]:
    """Turn any failure to read a file into a DatasetError."""
    try:
        # only files are opened: a pipe might block, and an address might start a download
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise ValueError("it is not a file")
        yield
    except FileNotFoundError as error:
        raise DatasetError(f"{path} does not exist") from error
    except PermissionError as error:
        raise DatasetError(f"{path} can't be read: {error.strerror}") from error
    except Exception as error:  # HDF5, netCDF4 and xarray raise all sorts for damaged bytes
        reason = str(error) or type(error).__name__
        raise DatasetError(f"{path} is damaged, or not of this project: {reason}") from error
