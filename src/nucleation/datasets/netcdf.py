"""Datasets as netCDF files, written whole or not at all, every variable with what it is."""

import contextlib
import hashlib
import json
import os
import stat
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr

from . import seal
from .files import replacing, require_room
from .variables import DatasetError, require_annotated

MAPPINGS = {"sources", "versions"}
STRUCTURES = {"parameters", *MAPPINGS}
TEXTS = {*STRUCTURES, "code_digest", "command", "content", "created"}
"""Attributes that say where a dataset is from: texts, some of them in JSON."""

CONVENTIONS = "CF-1.11"
"""What units, names and attributes follow: those of the climate and forecast community."""

TITLE = "Nucleation length of accelerating frictional slip"
OF_ROWS = "id"
"""The column of a table that names its rows; in a file it is their coordinate."""

NOISY = ("slip_rate", "shear_stress")
"""Not compressed: their last digits are noise, which takes long and saves a quarter."""

HEADERS = 2**20  # bytes of a file beside its values, at most


def write(dataset: xr.Dataset, path: str | os.PathLike[str], **attributes: Any) -> None:
    """Write a dataset to `path`: after a crash there is the whole file or none.

    The attribute ``content`` is the digest by which :func:`read` detects damage.

    Raises
    ------
    DatasetError
        If a variable lacks its unit or long name.
    """
    require_annotated(dataset)
    # an encoding left from reading may fit less: texts were cut to the length they had in a file
    complete = dataset.drop_encoding().assign_attrs(attributes)
    complete.attrs["Conventions"] = CONVENTIONS
    complete.attrs.setdefault("title", TITLE)
    if {"created", "command"} <= complete.attrs.keys():
        complete.attrs["history"] = f"{complete.attrs['created']}: {complete.attrs['command']}"
    complete.attrs["content"] = _content(complete)
    stored = {"zlib": True, "complevel": 1, "shuffle": True}
    encoding: dict[Any, dict[str, Any]] = {
        name: dict(stored)
        for name, variable in complete.variables.items()
        if variable.dtype.kind in "fiu" and variable.ndim and name not in NOISY
    }
    for name in complete.coords:
        encoding.setdefault(name, {})["_FillValue"] = None
    if OF_ROWS in complete and complete[OF_ROWS].ndim == 1:
        complete = complete.set_coords(OF_ROWS)
    with replacing(path) as temporary:
        try:
            complete.to_netcdf(temporary, engine="netcdf4", encoding=encoding)
            seal.add(temporary, _plain(complete.attrs))
        except (OSError, RuntimeError):  # "NetCDF: HDF error", of a full disk as of all else
            require_room(temporary, complete.nbytes + HEADERS)
            raise


def write_text(text: str, path: str | os.PathLike[str]) -> None:
    """Write a text file, whole or not at all."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def read(path: str | os.PathLike[str], requires: Iterable[str] = ()) -> xr.Dataset:
    """Read a whole dataset into memory and check it.

    Raises
    ------
    DatasetError
        If the file is missing, truncated or damaged, or lacks a variable or a unit.
    """
    with _refusing(path):
        sealed = seal.verified(path)  # before HDF5 is given a byte of it
        _require_texts(sealed)
        # as in the file, where xarray would move the coordinate of rows behind all columns
        with xr.open_dataset(
            path, engine="netcdf4", decode_times=False, decode_coords=False
        ) as stored:
            _require_memory(stored)
            dataset = _with_coordinates(stored.load())
        content = _content(dataset)
        if content != sealed.get("content") or _text(dataset.attrs) != _text(sealed):
            raise ValueError("its digest does not fit")
    missing = sorted(set(requires) - set(map(str, dataset.variables)))
    if missing:
        raise DatasetError(f"{path} lacks the variables {missing}")
    return dataset


def attributes(path: str | os.PathLike[str]) -> dict[str, Any]:
    """A dataset's attributes alone, from its seal, without a check of its values.

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
    """The dataset with what the file declares as coordinates, but for that of a table's rows."""
    declared = dataset.attrs.pop("coordinates", "").split()
    for variable in dataset.variables.values():
        declared += variable.attrs.pop("coordinates", "").split()
    return dataset.set_coords(sorted(set(declared) - {OF_ROWS}))


@contextlib.contextmanager
def _refusing(path: str | os.PathLike[str]) -> Iterator[None]:
    """Make a DatasetError of whatever goes wrong with a file."""
    try:
        # nothing else is opened: a pipe would be waited for, an address be asked for
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise ValueError("it is not a file")
        yield
    except FileNotFoundError as error:
        raise DatasetError(f"{path} does not exist") from error
    except PermissionError as error:
        raise DatasetError(f"{path} can't be read: {error.strerror}") from error
    except Exception as error:  # of damaged bytes, HDF5, netCDF4 and xarray raise all sorts
        reason = str(error) or type(error).__name__
        raise DatasetError(f"{path} is damaged, or not of this project: {reason}") from error


def _require_memory(dataset: xr.Dataset) -> None:
    """Refuse shapes beyond the machine's memory: a few bytes of a header can claim them."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    if dataset.nbytes > memory:
        raise ValueError(f"its variables would take {dataset.nbytes:.3g} bytes of memory")


def _require_texts(found: Mapping[Any, Any]) -> None:
    """Refuse attributes that tell where a file is from, but not in the form of :func:`write`."""
    for name in TEXTS & found.keys():
        if not isinstance(found[name], str):
            raise ValueError(f"its attribute {name} is not a text")
    for name in STRUCTURES & found.keys():
        value = json.loads(found[name])
        if name in MAPPINGS and not isinstance(value, dict):
            raise ValueError(f"its attribute {name} is not a mapping")


def _content(dataset: xr.Dataset) -> str:
    """Digest of all variables and attributes but ``content`` itself, the same after reading."""
    summary = hashlib.sha256(_text(dataset.attrs))
    for name in sorted(map(str, dataset.variables)):
        variable = dataset.variables[name]
        values = variable.values
        numbers = values.dtype.kind in "fiub"
        kind = values.dtype.str if numbers else "text"
        summary.update(f"{name} {kind} {variable.dims} {values.shape}\n".encode())
        summary.update(_text(variable.attrs))
        summary.update(
            np.ascontiguousarray(values).data if numbers else json.dumps(values.tolist()).encode()
        )
    return summary.hexdigest()


def _text(attributes: Mapping[str, Any]) -> bytes:
    """Attributes in a form that does not tell a Python number from numpy's."""
    plain = _plain({name: value for name, value in attributes.items() if name != "content"})
    return json.dumps(plain, sort_keys=True).encode()


def _plain(attributes: Mapping[Any, Any]) -> dict[str, Any]:
    """Attributes as values of Python."""
    return {str(name): np.asarray(value).tolist() for name, value in attributes.items()}
