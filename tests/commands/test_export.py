"""``nucleation export``: a time series at a point, as the SEAS benchmarks have them."""

import numpy as np
import pytest

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
    assert fields.split() == ["t", "slip", "slip_rate", "shear_stress", "state"]
    data = np.array([line.split() for line in lines if line[0] not in "#t"], dtype=float)
    expected = dataset.isel(x=2)
    np.testing.assert_allclose(data[:, 0], expected["time"])
    np.testing.assert_allclose(data[:, 1], expected["slip"], atol=1e-20)
    np.testing.assert_allclose(10.0 ** data[:, 2], np.abs(expected["slip_rate"]), 1e-9, 1e-299)
    np.testing.assert_allclose(1e6 * data[:, 3], expected["shear_stress"], 1e-9, 1e-9)
    np.testing.assert_allclose(10.0 ** data[:, 4], expected["state"], rtol=1e-9)
    middle = np.loadtxt([line for line in between.read_text().splitlines() if line[0] not in "#t"])
    mean = 0.5 * (dataset["slip"][:, 2] + dataset["slip"][:, 3])
    np.testing.assert_allclose(middle[:, 1], mean, atol=1e-20)


def test_mistakes_leave_no_file(nucleation, record):
    folder = record.parent / "series"
    ended = nucleation("export", record, folder, "--at", "10cm", "--at", "2m")
    assert ended.code == 2 and "at = 2 m is not allowed: it must lie on the interface" in ended.err
    ended = nucleation("export", record, folder, "--at", "3 kg")
    assert ended.code == 2 and "m is needed" in ended.err
    assert not folder.exists()
    assert nucleation("export", record, folder, "--at", "10cm").code == 0
    again = nucleation("export", record, folder, "--at", "10cm")
    assert again.code == 2 and "--force replaces it" in again.err
