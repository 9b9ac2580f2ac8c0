"""Damage of all sorts: a file is read as it was written, or refused before HDF5 reads a byte."""

import random

import numpy as np
import pytest
import xarray as xr
from declared import VARIABLES

from nucleation.datasets import netcdf
from nucleation.datasets.variables import DatasetError, annotate


def flip(content, random):
    content[random.randrange(len(content))] ^= 1 << random.randrange(8)


def truncate(content, random):
    del content[random.randrange(len(content)) :]


def overwrite(content, random):
    """Noise in the place of some bytes."""
    begin = random.randrange(len(content) - 8)
    content[begin : begin + 8] = random.randbytes(8)


def swap(content, random):
    one, other = (random.randrange(len(content) // 64) * 64 for _ in range(2))
    first, second = content[one : one + 64], content[other : other + 64]
    content[one : one + 64], content[other : other + 64] = second, first


@pytest.mark.parametrize("damage", [flip, truncate, overwrite, swap])
def test_damage_is_refused_in_one_way(damage, tmp_path, monkeypatch):
    path = tmp_path / "record.nc"
    rate = np.random.default_rng(1).random((40, 30))
    made = xr.Dataset({"slip_rate": (("time", "x"), rate), "id": ("x", ["a-φ"] * 30)})
    netcdf.write(annotate(made, VARIABLES), path, parameters='{"n": [1]}')
    whole = path.read_bytes()
    monkeypatch.setattr(xr, "open_dataset", None)
    for seed in range(50):
        content = bytearray(whole)
        damage(content, random.Random(seed))
        path.write_bytes(content)
        if bytes(content) != whole:
            with pytest.raises(
                DatasetError, match=r"record\.nc is damaged, or not of this project"
            ):
                netcdf.read(path)
