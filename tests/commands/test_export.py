"""``nucleation export``: a time series at a point, as the SEAS benchmarks have them."""

import re

import numpy as np
import pytest

from nucleation import __version__
from nucleation.datasets import netcdf

SMALL = ["--height", "5mm", "--length", "90cm", "--n-x", "16", "--n-y", "2", "--end-time", "20ms"]


@pytest.fixture
def record(nucleation, tmp_path):
    assert nucleation("simulate", tmp_path / "run.nc", *SMALL).code == 0
    return tmp_path / "run.nc"


def test_series_are_the_records_at_nodes_and_between(nucleation, record):
    folder = record.parent / "series"
    dataset = netcdf.read(record)
    step = float(dataset["x"][1])
    ended = nucleation("export", record, folder, "--at", f"{2 * step} m", "--at", f"{2.5 * step}m")
    assert ended.code == 0
    node, between = (folder / f"run_x{k * step:g}m.dat" for k in (2, 2.5))
    lines = node.read_text().splitlines()
    (fields,) = [line for line in lines if not line.startswith("#") and "slip" in line]
    assert fields.split() == ["t", "slip", "slip_rate", "shear_stress", "normal_stress", "state"]
    data = np.array([line.split() for line in lines if line[0] not in "#t"], dtype=float)
    expected = dataset.isel(x=2)
    np.testing.assert_allclose(data[:, 0], expected["time"])
    np.testing.assert_allclose(data[:, 1], expected["slip"], atol=1e-20)
    np.testing.assert_allclose(10.0 ** data[:, 2], np.abs(expected["slip_rate"]), 1e-9, 1e-299)
    np.testing.assert_allclose(1e6 * data[:, 3], expected["shear_stress"], 1e-9, 1e-9)
    np.testing.assert_allclose(-1e6 * data[:, 4], expected["normal_stress"], 1e-9)
    assert (data[:, 4] > 0.0).all()  # in compression
    np.testing.assert_allclose(10.0 ** data[:, 5], expected["state"], rtol=1e-9)
    middle = np.loadtxt([line for line in between.read_text().splitlines() if line[0] not in "#t"])
    mean = 0.5 * (dataset["slip"][:, 2] + dataset["slip"][:, 3])
    np.testing.assert_allclose(middle[:, 1], mean, atol=1e-20)


def test_header_is_that_of_the_benchmarks(nucleation, record):
    """What their descriptions ask for, in lines with #, before the one line of names."""
    folder = record.parent / "series"
    assert nucleation("export", record, folder, "--at", "10cm").code == 0
    head, _, data = (folder / "run_x0.1m.dat").read_text().partition("\nt slip slip_rate ")
    header = dict(line[2:].split("=", 1) for line in head.splitlines() if "=" in line)
    assert list(header)[:10] == [
        "problem", "author", "date", "code", "code_version", "element_size", "location",
        "minimum_time_step", "maximum_time_step", "num_time_steps",
    ]  # fmt: skip
    assert re.fullmatch(r"\d{4}/\d\d/\d\d", header["date"])
    assert header["code_version"] == __version__
    columns = [value for key, value in header.items() if key.startswith("Column #")]
    assert columns == [" Time (s)", " Slip (m)", " Slip rate (log10 m/s)", " Shear stress (MPa)",
                       " Normal stress (MPa)", " State (log10 s)"]  # fmt: skip
    said, *rows = data.splitlines()[1:]
    assert said == "# Here is the time-series data." and int(header["num_time_steps"]) == len(rows)


def test_fields_as_csv(nucleation, record):
    """The first column is the time, the first row x, the rest the record to nine digits."""
    folder, dataset = record.parent / "fields", netcdf.read(record)
    assert nucleation("export", record, folder).code == 0
    names = {path.stem.removeprefix("run_") for path in folder.iterdir()}
    assert {"slip", "slip_rate", "shear_stress", "normal_stress", "state"} <= names
    for name in names:
        head, *rows = (folder / f"run_{name}.csv").read_text().splitlines()
        assert head.startswith(f"{name} ({dataset[name].attrs['units']})")
        np.testing.assert_allclose(np.array(head.split(",")[1:], float), dataset["x"])
        values = np.array([row.split(",") for row in rows], float)
        np.testing.assert_allclose(values[:, 0], dataset["time"], 1e-8)
        np.testing.assert_allclose(values[:, 1:], dataset[name], 1e-8)


def test_mistakes_leave_no_file(nucleation, record):
    folder = record.parent / "series"
    ended = nucleation("export", record, folder, "--at", "10cm", "--at", "2m")
    assert ended.code == 2 and "at = 2 m is not allowed: it must lie on the interface" in ended.err
    ended = nucleation("export", record, folder, "--at", "3 kg")
    assert ended.code == 2 and "m is needed" in ended.err
    assert not folder.exists()
    ended = nucleation("export", record, folder / "deep", "--at", "10cm")
    assert ended.code == 2 and f"there is no directory {folder}; mkdir -p" in ended.err
    assert not folder.exists()
    assert nucleation("export", record, folder, "--at", "10cm").code == 0
    again = nucleation("export", record, folder, "--at", "10cm")
    assert again.code == 2 and "--force replaces it" in again.err
