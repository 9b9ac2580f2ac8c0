"""The description of an archive for machines; of a whole archive's, see tests/workflow."""

import json
import subprocess

import pytest
from configurations import CONFIG

from nucleation.configuration.load import load
from nucleation.pipeline import crate
from nucleation.pipeline.crate import Packed


@pytest.fixture(scope="module")
def entities():
    files = {"config.yaml": Packed("0" * 64, 3), "results/a b.nc": Packed("1" * 64, 5)}
    text = crate.text(load(CONFIG / "quick.yaml"), files, "2026-01-01T00:00:00+00:00")
    return {entity["@id"]: entity for entity in json.loads(text)["@graph"]}


def test_every_parameter_has_its_value_and_unit(entities):
    base = load(CONFIG / "quick.yaml").base.to_dict()
    for group in ("material", "friction", "loading"):
        for name, value in base[group].items():
            assert entities[f"#{group}.{name}"]["value"] == value
    assert entities["#friction.characteristic_slip_distance"]["unitText"] == "m"
    assert "unitText" not in entities["#friction.aging_coefficient"]


def test_name_of_a_file_is_an_address(entities):
    assert entities["results/a%20b.nc"]["name"] == "results/a b.nc"
    assert entities["#making"]["result"] == [{"@id": "results/a%20b.nc"}]


def test_commit_is_that_of_the_checkout_itself(tmp_path):
    assert crate.commit(tmp_path) is None

    def git(*arguments):
        names = ["-c", "user.name=a", "-c", "user.email=a@b.example"]
        subprocess.run(["git", "-C", tmp_path, *names, *arguments], check=True, capture_output=True)

    git("init")
    assert crate.commit(tmp_path) is None, "there is none yet"
    (tmp_path / "a").write_text("1")
    git("add", "a")
    git("commit", "-m", "a")
    assert len(crate.commit(tmp_path)) == 40
    (tmp_path / "a").write_text("2")
    assert crate.commit(tmp_path).endswith(", with changes that are not committed")
    (tmp_path / "below").mkdir()
    assert crate.commit(tmp_path / "below") is None, "a release unpacked within another project"
