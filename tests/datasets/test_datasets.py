"""Datasets on disk: any is read as it was written, whole or not at all, and damage is noticed."""

import errno
import os
import random
import resource
import string

import numpy as np
import pytest
import xarray as xr
from declared import VARIABLES
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from nucleation.datasets import netcdf
from nucleation.datasets.variables import DatasetError, annotate
from replication.tables import lengths


def declared(*data) -> xr.Dataset:
    return annotate(xr.Dataset(*data), VARIABLES)


@pytest.fixture
def record() -> xr.Dataset:
    rate = np.random.default_rng(1).random((40, 30))
    return declared(
        {"slip_rate": (("time", "x"), rate), "id": ("run", ["a-φ", "b"]), "velocity": 1e-5},
        {"time": np.arange(40.0), "x": np.linspace(0.0, 1.0, 30)},
    )


def test_written_dataset_is_read_again_with_metadata(record, tmp_path):
    path = tmp_path / "deep" / "record.nc"
    netcdf.write(record, path, parameters="{}", code_digest="1")
    again = netcdf.read(path)
    xr.testing.assert_equal(again, record)
    assert again.attrs.pop("Conventions") == netcdf.CONVENTIONS == "CF-1.11"
    assert again.attrs.pop("title") == netcdf.TITLE
    assert again.attrs == {"parameters": "{}", "code_digest": "1"}
    assert again["slip_rate"].attrs["units"] == "m/s"
    assert again["time"].attrs == {"units": "s", "long_name": "time", "symbol": "t"}
    assert [file.name for file in path.parent.iterdir()] == ["record.nc"]
    with xr.open_dataset(path, decode_times=False) as stored:  # which does not see the seal
        xr.testing.assert_equal(stored.load().reset_coords("id"), record)


def test_variable_that_is_not_declared_is_refused(record, tmp_path):
    bare = record.assign(slip_ratio=("time", np.ones(40)))
    with pytest.raises(DatasetError, match=r"without unit or long name: \['slip_ratio'\]"):
        netcdf.write(bare, tmp_path / "record.nc")
    assert not list(tmp_path.iterdir())


def test_failed_write_leaves_the_old_file(record, tmp_path, monkeypatch):
    path = tmp_path / "record.nc"
    netcdf.write(record, path)
    old = path.read_bytes()

    def half(self, target, **_):
        target.write_bytes(b"half a file")
        raise OSError("no space left on device")

    monkeypatch.setattr(xr.Dataset, "to_netcdf", half)
    with pytest.raises(OSError, match="no space"):
        netcdf.write(record, path)
    assert path.read_bytes() == old
    assert [file.name for file in tmp_path.iterdir()] == ["record.nc"]


def test_foreign_and_missing_files_are_refused(record, tmp_path):
    path = tmp_path / "record.nc"
    with pytest.raises(DatasetError, match="does not exist"):
        netcdf.read(path)
    record.to_netcdf(path)
    with pytest.raises(DatasetError, match="not of this project"):
        netcdf.read(path)


def test_joined_tables_keep_their_longest_text(tmp_path):
    """The text length of the file that was read first must not cut the others."""
    for name in ("short", "a longer one"):
        netcdf.write(declared({"id": ("run", [name])}), tmp_path / f"{len(name)}.nc")
    tables = [netcdf.read(path) for path in sorted(tmp_path.iterdir(), reverse=True)]
    netcdf.write(lengths.join(tables), tmp_path / "all.nc")
    joined = netcdf.read(tmp_path / "all.nc")
    assert list(joined["id"].values) == ["short", "a longer one"]


def test_only_files_are_opened(tmp_path):
    """A pipe would be waited for, a device read without end, and an address be asked for."""
    os.mkfifo(tmp_path / "pipe.nc")
    for path in (tmp_path / "pipe.nc", tmp_path, "/dev/zero", "http://localhost:9/a.nc"):
        for reading in (netcdf.read, netcdf.attributes):
            with pytest.raises(DatasetError, match=r"it is not a file|does not exist"):
                reading(path)


def test_lack_of_room_is_said_by_the_system(tmp_path):
    """HDF5 says "HDF error" of a limit on files' sizes, as of a full disk or a quota."""
    large = declared({"slip_rate": ("x", np.random.default_rng(1).random(30_000))})
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, limits[1]))
    try:
        with pytest.raises(OSError, match="File too large") as caught:
            netcdf.write(large, tmp_path / "record.nc")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert caught.value.errno == errno.EFBIG
    assert not list(tmp_path.iterdir())


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
def test_damage_is_refused_before_hdf5_reads_a_byte(record, damage, tmp_path, monkeypatch):
    path = tmp_path / "record.nc"
    netcdf.write(record, path, parameters='{"n": [1]}')
    whole = path.read_bytes()
    monkeypatch.setattr(xr, "open_dataset", None)
    for seed in range(50):
        content = bytearray(whole)
        damage(content, random.Random(seed))
        path.write_bytes(content)
        if bytes(content) != whole:
            with pytest.raises(DatasetError, match=r"record\.nc is damaged, or not of this"):
                netcdf.read(path)


NUMBERS = [name for name, entry in VARIABLES.items() if entry.units]
WORDS = [name for name, entry in VARIABLES.items() if not entry.units]
# What netCDF can hold: no surrogates, and no zeros, which end a text.
texts = st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=30)
types = st.sampled_from(["f4", "f8", "i1", "i2", "i4", "i8", "u1", "u2", "u4"]).map(np.dtype)


@st.composite
def datasets(draw):
    """Variables of the table, of any type and shape, with any values (NaN and infinity too)."""
    sizes = {name: draw(st.integers(1, 5)) for name in ("rows", "columns")}
    dataset = xr.Dataset()
    for name in draw(st.lists(st.sampled_from(NUMBERS), unique=True, max_size=4)):
        dims = draw(st.sampled_from([(), ("rows",), ("rows", "columns")]))
        shape = tuple(sizes[dim] for dim in dims)
        dataset[name] = dims, draw(arrays.arrays(draw(types), shape))
    for name in draw(st.lists(st.sampled_from(WORDS), unique=True, max_size=2)):
        words = draw(st.lists(texts, min_size=sizes["rows"], max_size=sizes["rows"]))
        dataset[name] = "rows", np.array(words)
    return annotate(dataset, VARIABLES)


attributes = st.dictionaries(
    st.text(string.ascii_lowercase, min_size=1, max_size=9).map("own_{}".format),
    texts.filter(bool) | st.integers(-(2**31), 2**31) | st.floats(allow_nan=False),
    max_size=4,
)


@settings(max_examples=60)
@given(datasets(), attributes)
def test_round_trip(tmp_path_factory, dataset, given):
    path = tmp_path_factory.getbasetemp() / "round_trip.nc"
    netcdf.write(dataset, path, **given)
    again = netcdf.read(path)
    assert set(again.variables) == set(dataset.variables)
    for name in dataset.variables:
        written, read = dataset[name], again[name]
        assert read.dims == written.dims
        np.testing.assert_array_equal(read.values, written.values)
        assert read.dtype.kind in "UO" if name in WORDS else read.dtype == written.dtype
        assert read.attrs.get("units", "") == VARIABLES[name].units
    for name, value in given.items():
        assert again.attrs[name] == value
        assert netcdf.attributes(path)[name] == pytest.approx(value)
