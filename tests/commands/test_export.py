"""``nucleation export``: the fields of a record as text."""

import numpy as np
import pytest

from nucleation.datasets import netcdf

SMALL = ["--height", "5mm", "--length", "90cm", "--n-x", "16", "--n-y", "2", "--end-time", "20ms"]


@pytest.fixture
def record(nucleation, tmp_path):
    assert nucleation("simulate", tmp_path / "run.nc", *SMALL).code == 0
    return tmp_path / "run.nc"


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
    folder = record.parent / "fields"
    ended = nucleation("export", record, folder / "deep")
    assert ended.code == 2 and f"there is no directory {folder}; mkdir -p" in ended.err
    assert not folder.exists()
    assert nucleation("export", record, folder).code == 0
    again = nucleation("export", record, folder)
    assert again.code == 2 and "--force replaces it" in again.err
