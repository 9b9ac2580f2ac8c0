"""The first hour of a researcher with a study of her own: mistakes, table, figure, check."""

import pandas as pd
import pytest

from nucleation.datasets import netcdf

STUDY = """
material: {shear_modulus: 30 GPa, poisson_ratio: 1/4, density: 2650 kg/m3}
loading: {normal_stress: 5 MPa, velocity: 10 um/s}
stepping: {end_time: 5 min, time_after_event: 0, tolerance: 0.1, longest_step: 0.3}
studies:
  granite:
    description: granite layers of two heights
    fault: paper  # on a rigid base, with its friction law
    length_over_critical: 3
    defaults: {slip_distance: 5 um, a: 0.008, friction: 0.47, zeta_over_a: 2, n_x: 60, n_y: 4}
    runs:
      - height: [2 cm, 5 cm]
      - {height: 4 cm, end_time: 20 s}
"""


@pytest.mark.system
def test_in_the_workflow(workflow):
    """A study with a mistake, then without; its table and figure, and a check of all."""
    wrong = workflow.configured(STUDY.replace("5 MPa", "5 mPas").replace("zeta_over_a", "zetta"))
    done = wrong("figures", "--dry-run")
    assert done.returncode != 0 and "the configuration has" in done.stdout
    assert "Traceback (most recent call last)" not in done.stdout

    own = workflow.configured(STUDY)
    (own.directory / "nucleation.py").write_text("raise SystemExit('not that of the project')")
    printed = own.printed("figures")
    assert "simulated time too short (granite-aging-H0.04-phi1-end_time20)" in printed
    assert "study granite: 1 of 3 runs had no event" in printed
    assert "after 20" in printed and "a longer end_time may show it" in printed

    results = own.directory / "results"
    table = pd.read_csv(results / "lengths.csv").set_index("id")
    everything = netcdf.read(results / "lengths.nc")
    assert set(everything["shear_modulus"].values) == {3e10} and set(table.a.round(9)) == {0.008}
    assert table.length.isna().sum() == 1 and (table.reached_length > 0.0).all()
    columns = pd.read_csv(results / "lengths.columns.csv").set_index("column")
    assert set(columns.index) == set(everything.data_vars) > set(table.columns)
    assert "shear_modulus" not in table and columns.units["length"] == "m"
    attributes = netcdf.attributes(results / "lengths.nc")
    assert attributes["Conventions"].startswith("CF-")

    assert not (results / "figures" / "figure_3.png").exists()
    report = own.directory / "report.html"
    assert own("figures", "--report", str(report)).returncode == 0
    html = report.read_text(encoding="utf-8")
    assert "study_granite" in html and "granite layers" in html

    assert own("check").returncode == 0
    (results / "figures" / "study_granite.png").unlink()
    (results / "figures" / "study_granite.png").write_bytes(b"another picture")
    checked = own("check")
    assert checked.returncode != 0 and "study_granite.png" in checked.stdout
