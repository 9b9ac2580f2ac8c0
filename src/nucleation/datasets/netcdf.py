"""The datasets' variables in one table, and netCDF files written whole or not at all.

Numerics and metadata are two layers: computations return bare datasets, :func:`annotate` gives
every variable its unit, long name and paper symbol from :data:`VARIABLES`.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from .files import replacing
from .variables import (
    DatasetError,
    annotate,
)


def write(dataset: xr.Dataset, path: str | os.PathLike[str], **attributes: Any) -> None:
    """Write an annotated dataset to `path`: after a crash there is the whole file or none.

    The attribute ``content`` is the digest by which :func:`read` detects damage.
    """
    # an encoding left from reading may fit less: texts were cut to the length they had in a file
    complete = annotate(dataset).drop_encoding().assign_attrs(attributes)
    complete.attrs["content"] = _content(complete)
    stored = {"zlib": True, "complevel": 1, "shuffle": True}
    encoding = {
        name: stored
        for name, variable in complete.variables.items()
        if variable.dtype.kind in "fiu" and variable.ndim
    }
    with replacing(path) as temporary:
        complete.to_netcdf(temporary, engine="netcdf4", encoding=encoding)


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
    try:
        with xr.open_dataset(path, engine="netcdf4", decode_times=False) as stored:
            dataset = stored.load()
    except FileNotFoundError as error:
        raise DatasetError(f"{path} does not exist") from error
    except (OSError, RuntimeError, ValueError) as error:
        raise DatasetError(f"{path} is damaged or not a netCDF file: {error}") from error
    if dataset.attrs.get("content") != _content(dataset):
        raise DatasetError(f"{path} is damaged, or not of this project: its digest does not fit")
    missing = sorted(set(requires) - set(map(str, dataset.variables)))
    if missing:
        raise DatasetError(f"{path} lacks the variables {missing}")
    return dataset


def attributes(path: str | os.PathLike[str]) -> dict[str, Any]:
    """A dataset's attributes alone, without a check of its values.

    Raises
    ------
    DatasetError
        If the file is missing or can't be opened.
    """
    try:
        with xr.open_dataset(path, engine="netcdf4", decode_times=False) as stored:
            return dict(stored.attrs)
    except (OSError, RuntimeError, ValueError) as error:
        raise DatasetError(f"{path} is missing, damaged or not a netCDF file: {error}") from error


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
    plain = {k: np.asarray(v).tolist() for k, v in attributes.items() if k != "content"}
    return json.dumps(plain, sort_keys=True).encode()
