"""Datasets in netCDF files, written completely or not at all, with metadata for every variable."""

import contextlib
import hashlib
import json
import os
import stat
from collections.abc import Hashable, Iterable, Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr

from . import DatasetError, seal
from .files import replacing, require_room
from .variables import require_annotated

_MAPPINGS = {"sources", "versions"}
STRUCTURES = {"parameters", *_MAPPINGS}
TEXTS = {*STRUCTURES, "code_digest", "command", "content", "created"}
"""Attributes with the origin of a dataset: texts, and structures in JSON."""

CONVENTIONS = "CF-1.11"
"""The conventions that units, names and attributes follow (climate and forecast community)."""

TITLE = "Nucleation length of accelerating frictional slip"
_ROWS = "id"
"""The column that names the rows of a table; in a file it is their coordinate."""

_NOISY = ("slip_rate", "shear_stress")
"""Not compressed: their last digits are noise, so compression is slow and saves a quarter."""

_HEADERS = 2**20  # bytes of a file besides its values, at most


def write(dataset: xr.Dataset, path: str | os.PathLike[str], **attributes: Any) -> None:
    """Write a dataset, so that a crash leaves the whole file or none.

    The attribute ``content`` is a digest, by which :func:`read` detects damage.

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
    attrs["content"] = _digest(complete)
    encoding = _encoding(complete)
    if _ROWS in complete and complete[_ROWS].ndim == 1:
        complete = complete.set_coords(_ROWS)
    with replacing(path) as temporary:
        try:
            complete.to_netcdf(temporary, engine="netcdf4", encoding=encoding)
            seal.add(temporary, _plain(complete.attrs))
        except (OSError, RuntimeError):  # "NetCDF: HDF error", for a full disk and all else
            require_room(temporary, complete.nbytes + _HEADERS)
            raise


def _encoding(dataset: xr.Dataset) -> dict[Hashable, dict[str, Any]]:
    encoding: dict[Hashable, dict[str, Any]] = {}
    for name, variable in dataset.variables.items():
        has_numbers = variable.dtype.kind in "fiu" and variable.ndim > 0
        if has_numbers and name not in _NOISY:
            encoding[name] = {
                "zlib": True,
                "complevel": 1,
                "shuffle": True,
            }
    for name in dataset.coords:
        encoding.setdefault(name, {})["_FillValue"] = None
    return encoding


def write_text(text: str, path: str | os.PathLike[str]) -> None:
    """Write a text file completely or not at all.

    Parameters
    ----------
    text : str
        Content.
    path : path
        The file; an older one is replaced.
    """
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def read(path: str | os.PathLike[str], requires: Iterable[str] = ()) -> xr.Dataset:
    """Read a dataset into memory and check it.

    Parameters
    ----------
    path : path
        The file.
    requires : iterable of str
        Variables that the dataset must have.

    Returns
    -------
    Dataset
        The dataset as it was written, with the attributes that :func:`write` added.

    Raises
    ------
    DatasetError
        If the file is missing, truncated or damaged, or lacks a variable or a unit.

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
        sealed = seal.verified(path)  # before HDF5 reads any byte
        _require_texts(sealed)
        # xarray would move the coordinate of the rows behind all columns
        with xr.open_dataset(
            path,
            engine="netcdf4",
            decode_times=False,
            decode_coords=False,
        ) as stored:
            _require_memory(stored)
            dataset = _with_coordinates(stored.load())
        digest = _digest(dataset)
        if digest != sealed.get("content") or _text(dataset.attrs) != _text(sealed):
            raise ValueError("its digest does not fit")
    missing = sorted(set(requires) - set(map(str, dataset.variables)))
    if missing:
        raise DatasetError(f"{path} lacks the variables {missing}")
    return dataset


def attributes(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Read the attributes of a dataset from its seal, without a check of its values.

    Raises
    ------
    DatasetError
        If the file is missing or can't be read.
    """
    with _refusing(path):
        sealed = seal.attributes(path)
        _require_texts(sealed)
    return sealed


def _with_coordinates(dataset: xr.Dataset) -> xr.Dataset:
    """Make the declared coordinates coordinates, except the one of a table's rows."""
    declared = dataset.attrs.pop("coordinates", "").split()
    for variable in dataset.variables.values():
        declared += variable.attrs.pop("coordinates", "").split()
    return dataset.set_coords(sorted(set(declared) - {_ROWS}))


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


def _require_memory(dataset: xr.Dataset) -> None:
    """Refuse shapes beyond the machine's memory: a few bytes of a header can declare them."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    if dataset.nbytes > memory:
        raise ValueError(f"its variables would take {dataset.nbytes:.3g} bytes of memory")


def _require_texts(found: Mapping[str, Any]) -> None:
    """Refuse attributes of origin in another form than that of :func:`write`."""
    for name in TEXTS & found.keys():
        if not isinstance(found[name], str):
            raise ValueError(f"its attribute {name} is not a text")
    for name in STRUCTURES & found.keys():
        value = json.loads(found[name])
        if name in _MAPPINGS and not isinstance(value, dict):
            raise ValueError(f"its attribute {name} is not a mapping")


def _digest(dataset: xr.Dataset) -> str:
    """Digest of all variables and attributes except ``content``; reading does not change it."""
    summary = hashlib.sha256(_text(dataset.attrs))
    for name in sorted(map(str, dataset.variables)):
        variable = dataset.variables[name]
        values = variable.values
        has_numbers = values.dtype.kind in "fiub"
        kind = values.dtype.str if has_numbers else "text"
        summary.update(f"{name} {kind} {variable.dims} {values.shape}\n".encode())
        summary.update(_text(variable.attrs))
        if has_numbers:
            summary.update(np.ascontiguousarray(values).data)
        else:
            summary.update(json.dumps(values.tolist()).encode())
    return summary.hexdigest()


def _text(attributes: Mapping[Any, Any]) -> bytes:
    """Attributes as JSON, the same for numbers of Python and of NumPy."""
    counted = {name: value for name, value in attributes.items() if name != "content"}
    return json.dumps(_plain(counted), sort_keys=True).encode()


def _plain(attributes: Mapping[Any, Any]) -> dict[str, Any]:
    """Attributes as values of Python."""
    return {str(name): np.asarray(value).tolist() for name, value in attributes.items()}
