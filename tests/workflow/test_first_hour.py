"""The first hour of a researcher with a fault of her own: commands, library, workflow, mistakes."""

import json

import pandas as pd
import pytest

from nucleation import api, commands
from nucleation.datasets import netcdf

FAULT = ["--shear-modulus", "30 GPa", "--poisson", "1/4", "--normal-stress", "5MPa", "--a", "0.008",
         "--zeta", "0.016", "--slip-distance", "5 µm", "--friction", "0.47", "--height", "5cm",
         "--second-body", "rigid", "--velocity", "10 µm/s"]  # fmt: skip
SIMULATED = ["--shear-modulus", "30 GPa", "--poisson", "1/4", "--density", "2650 kg/m3",
             "--normal-stress", "5MPa", "--slip-distance", "5 µm", "--friction-coefficient", "0.47",
             "--direct-effect", "0.008", "--zeta-over-a", "2", "--height", "5cm",
             "--velocity", "10 µm/s", "--n-x", "60", "--n-y", "4", "--tolerance", "0.1",
             "--longest-step", "0.3", "--length-over-critical", "3"]  # fmt: skip
STUDY = """
material: {shear_modulus: 30 GPa, poisson_ratio: 1/4, density: 2650 kg/m3}
loading: {normal_stress: 5 MPa, velocity: 10 um/s}
stepping: {end_time: 5 min, time_after_event: 0, tolerance: 0.1, longest_step: 0.3}
studies:
  granite:
    description: granite layers of two heights
    length_over_critical: 3
    defaults: {slip_distance: 5 um, a: 0.008, f: 0.47, zeta_over_a: 2, n_x: 60, n_y: 4}
    runs:
      - height: [2 cm, 5 cm]
      - {height: 4 cm, end_time: 20 s}
"""


def said(capfd, *words):
    """Exit code, standard output and standard error of a command line."""
    capfd.readouterr()
    code = commands.run([str(word) for word in words])
    return code, *capfd.readouterr()


def test_in_the_command_line_and_the_library(capfd, tmp_path):
    """One length by every way in, and the mistakes that are made on the way."""
    code, _, err = said(capfd, "length", *FAULT[:-2], "--velocity", "10 s")
    assert code == 2 and "velocity" in err and "m/s is needed" in err
    code, out, _ = said(capfd, "length", *FAULT, "--json")
    critical = json.loads(out)["theory"]["critical_length"]
    assert code == 0
    fault = dict(poisson_ratio=0.25, normal_stress=5e6, direct_effect=0.008, zeta=0.016,
                 characteristic_slip_distance=5e-6, friction_coefficient=0.47, height=0.05,
                 second_shear_modulus=float("inf"))  # fmt: skip
    assert api.critical_length(shear_modulus=30e9, **fault) == pytest.approx(critical, rel=1e-12)
    with pytest.warns(UserWarning, match="hardly what is meant"):
        api.critical_length(shear_modulus=30.0, **fault)  # GPa was thought of

    output = tmp_path / "run.nc"
    code, _, err = said(capfd, "simulate", output, *SIMULATED, "--length", "10 cm")
    assert code == 2 and "longer than the critical" in err and "configuration" not in err
    code, out, err = said(capfd, "simulate", output, *SIMULATED, "--json")
    told = json.loads(out)
    assert code == 0 and told["theory"]["critical_length"] == pytest.approx(critical, rel=1e-6)
    assert 0.4 * critical < told["event"]["length"] < critical  # no end time was given
    assert "mesh too coarse along x" in err
    code, out, _ = said(capfd, "show", output)
    assert code == 0 and "of the theory's" in out and ", that of this installation" in out
    control = ["--zeta-over-a=-0.5", "--length", "1m", "--end-time", "1s", "--height", "5cm"]
    code, out, err = said(capfd, "simulate", tmp_path / "control.nc", *control, "--dry-run")
    assert code == 0 and "no critical length" in out and "nothing will nucleate" in err


@pytest.mark.system
def test_in_the_workflow(workflow):
    """A study with a mistake, then without; its table, figure, report, and a check of all."""
    wrong = workflow.configured(STUDY.replace("5 MPa", "5 mPas").replace("zeta_over_a", "zetta"))
    done = wrong("report", "--dry-run")
    assert done.returncode != 0 and "the configuration has" in done.stdout
    assert "Traceback (most recent call last)" not in done.stdout

    own = workflow.configured(STUDY)
    done = own("report")
    assert done.returncode == 0, done.stdout
    assert "simulated time too short (granite-aging-H0.04-phi1-end_time20)" in done.stdout
    assert "study granite: 1 of 3 runs had no event" in done.stdout
    assert "after 20" in done.stdout and "a longer end_time may show it" in done.stdout

    results = own.directory / "results"
    table = pd.read_csv(results / "lengths.csv").set_index("id")
    assert set(table.shear_modulus) == {3e10} and set(table.direct_effect.round(9)) == {0.008}
    assert table.length.isna().sum() == 1 and (table.reached_length > 0.0).all()
    columns = pd.read_csv(results / "lengths.columns.csv").set_index("column")
    assert set(columns.index) == {"id", *table.columns} and columns.units["length"] == "m"
    attributes = netcdf.attributes(results / "lengths.nc")
    assert attributes["Conventions"].startswith("CF-")

    html = (results / "report.html").read_text(encoding="utf-8")
    body = html.partition("<main")[2]
    assert body.index("Study granite") < body.index("The theory, for any material")
    assert "1 of 3 runs had no event" in body and "Warned of before the runs" in body
    assert "What was replicated" not in html and '<figure id="figure_3">' not in html

    assert own("check").returncode == 0
    (results / "figures" / "study_granite.png").unlink()
    (results / "figures" / "study_granite.png").write_bytes(b"another picture")
    checked = own("check")
    assert checked.returncode != 0 and "study_granite.png" in checked.stdout
