"""The report and Snakemake's own, made by the workflow on coarse grids."""

import json
import shutil

import pytest

from replication.configuration.load import load, read_yaml
from replication.figures import catalogue

STUDIES = ("paper", "converged")


@pytest.fixture(scope="module")
def reported(quick, tmp_path_factory, workflow_type):
    """The report on the quick configuration's runs for Figure 3 and a study of one's own."""
    directory = tmp_path_factory.mktemp("reported")
    shutil.copytree(quick.directory / "results", directory / "results", symlinks=True)
    config = read_yaml(quick.config)
    config["studies"] = {name: config["studies"][name] for name in STUDIES}
    config["studies"]["mine"] = {
        "description": "a study of one's own",
        "length_over_critical": 4.0,
        "defaults": {"n_x": 60, "n_y": 6, "time_after_event": 0.0},
        "runs": [{"height": 0.02}],
    }
    made = workflow_type(directory).configured(config)
    done = made("report")
    assert done.returncode == 0, done.stdout
    return made


@pytest.fixture(scope="module")
def results(reported):
    return reported.directory / "results" / "quick"


def test_report_has_every_figure_of_the_configuration(reported, results):
    html = (results / "report.html").read_text(encoding="utf-8")
    expected = catalogue.drawable(list(STUDIES))
    assert "figure_sensitivity" not in expected
    for name in catalogue.FIGURES:
        assert (f'<figure id="{name}">' in html) == (name in expected)
    assert '<figure id="study_mine">' in html and "Study mine: a study of one" in html
    for run in load(reported.config).runs:
        assert run.id in html
    claims = json.loads((results / "tables" / "claims.json").read_text(encoding="utf-8"))
    assert html.count('<tr role="row" data-kind=') == len(claims) > 30
    assert "http://" not in html.split("<script", 1)[0].replace("http://www.w3.org", "")
    assert reported.planned("report") == {}
