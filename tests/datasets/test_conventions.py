"""Datasets follow the CF conventions: each variable says what it is, in units of UDUNITS."""

import json
import math

import pytest
import xarray as xr
from cf_units import Unit
from declared import VARIABLES

from nucleation.datasets import netcdf
from nucleation.datasets.provenance import attributes
from nucleation.datasets.variables import Column, columns, table, to_csv
from nucleation.model import units
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.run import simulate
from replication.tables.curves import theory_dataset

NUMBERS = {name: entry for name, entry in VARIABLES.items() if entry.units}


@pytest.mark.parametrize("written", sorted({entry.units for entry in NUMBERS.values()}))
def test_units_are_those_of_udunits(written):
    """Read to the same quantity by the library of the conventions as by our own."""
    read = Unit(written)
    assert not read.is_unknown()
    own = units.registry().parse_units("" if written == "1" else written)
    factor, base = units.registry().get_base_units(own)
    assert read.convert(1.0, Unit(f"{base:~}".replace(" ", "") or "1")) == pytest.approx(factor)


FILES = {
    "table": lambda: table([{"id": "a", "length": 0.1}, {"id": "b", "length": math.nan}], COLUMNS),
    "curve": lambda: theory_dataset(PAPER_RUN, CURVES),
    "simulation": lambda: simulate(SHORT),
}
CURVES = {"heights": [0.01, 0.1], "f_beta": [0.0, 0.1], "zeta_over_a": [1.0, 2.0]}
CURVES["slip_rates"] = [1e-6, 1e-5]
LENGTH = Column("length", "m", "length at the drop", "L")
ID = Column("id", "", "name of the run")
COLUMNS = columns(ID, LENGTH)
SHORT = PAPER_RUN.replaced(height=0.02, block_length=0.4, n_x=16, n_y=4, end_time=1e-3)
NAMED_BY_CLIMATE = (
    "Coordinate variable 'time' should have standard_name='time'",
    "Coordinate variable 'height' should have standard_name='height'",
)
"""Simulated time has no date, and the height of a block is no coordinate of the atmosphere."""


@pytest.mark.slow
@pytest.mark.parametrize("make", FILES.values(), ids=FILES)
def test_files_follow_the_conventions(make, tmp_path):
    """By the checker of the conventions: no error, and title and history are there."""
    from compliance_checker.runner import CheckSuite, ComplianceChecker

    path = tmp_path / "result.nc"
    netcdf.write(make(), path, **attributes({}, "0" * 64, "snakemake result.nc"))
    CheckSuite.load_all_available_checkers()
    report = tmp_path / "report.json"
    ComplianceChecker.run_checker(
        str(path), ["cf:1.11"], 0, "normal", output_filename=str(report), output_format="json"
    )
    (found,) = json.loads(report.read_text()).values()
    messages = [
        text
        for part in ("high_priorities", "medium_priorities")
        for check in found[part]
        for text in check["msgs"]
    ]
    assert [text for text in messages if not text.startswith(NAMED_BY_CLIMATE)] == []


def test_rows_have_a_coordinate_in_the_file_and_columns_keep_their_order(tmp_path):
    path = tmp_path / "table.nc"
    netcdf.write(table([{"id": "a", "length": 0.1}], columns(LENGTH, ID)), path)
    assert list(xr.open_dataset(path).coords) == ["id"]
    found = netcdf.read(path)
    assert list(found.data_vars) == ["length", "id"] and not found.coords
    assert to_csv(found) == "length,id\n0.1,a\n"
