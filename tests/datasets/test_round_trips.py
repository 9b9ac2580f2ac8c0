"""Any dataset that is written is read again: every type, value, text and attribute."""

import string

import numpy as np
import pytest
import xarray as xr
from declared import VARIABLES
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from nucleation.datasets import netcdf
from nucleation.datasets.variables import annotate

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
