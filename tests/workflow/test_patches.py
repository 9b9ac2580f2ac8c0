"""The stability of a study's patches, made in one job: each as by itself, and found again."""

import shutil
from pathlib import Path

import pytest

from nucleation.datasets import netcdf
from nucleation.fault.files import read_yaml

QUICK = read_yaml(Path(__file__).parents[2] / "config" / "quick.yaml")
TARGET = "patch_convergence"


def configuration(study_name, heights):
    study = QUICK["studies"]["converged"] | {"runs": [{"evolution": "aging", "height": heights}]}
    study["defaults"] = study["defaults"] | {"time_after_event": 0.0, "n_x": 40, "n_y": 4}
    return {**QUICK, "studies": {study_name: study}}


def patches(workflow):
    """Those that are shown, in the store, by their keys."""
    shown = (workflow.directory / "results/quick/patches").glob("*.nc")
    return {path.parent.name: path for path in (path.resolve() for path in shown)}


@pytest.fixture(scope="module")
def together(workflow_type, tmp_path_factory):
    workflow = workflow_type(tmp_path_factory.mktemp("together"))
    workflow = workflow.configured(configuration("converged", [0.08, 0.1]))
    planned = workflow.planned(TARGET)
    assert planned == {"simulate": 2, "follow_patches": 1, "gather_patches": 1}
    workflow.printed(TARGET, "--cores", "2")
    return workflow


def test_each_is_what_its_own_job_makes(together):
    """From its own simulation, with the code that its key is made of."""
    datasets = {key: netcdf.read(path) for key, path in patches(together).items()}
    assert len(datasets) == 2
    for path in patches(together).values():
        shutil.rmtree(path.parent)
    for height in (0.08, 0.1):  # alone in its study, in a job by itself
        alone = together.configured(configuration("converged", [height]), "alone.yaml")
        assert alone.planned(TARGET) == {"follow_patches": 1, "gather_patches": 1}
        alone.printed(TARGET, "--cores", "1")
    store = together.directory / "results/quick/store"
    for key, expected in datasets.items():
        found = netcdf.read(store / key / "result.nc")
        assert found.drop_attrs().identical(expected.drop_attrs())
        for name in ("key", "code_digest", "sources", "parameters"):
            assert found.attrs[name] == expected.attrs[name], name
