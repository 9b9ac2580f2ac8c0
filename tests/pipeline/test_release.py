"""A release: its parts, its checksums, and metadata that agree with the project's."""

import json
import re
import subprocess
import tarfile
import tomllib
from pathlib import Path

import pytest
import yaml

import nucleation
from nucleation.pipeline import bundle, release

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
CITED = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
ZENODO = json.loads((ROOT / ".zenodo.json").read_text("utf-8"))
CODEMETA = json.loads((ROOT / "codemeta.json").read_text("utf-8"))


@pytest.mark.slow
@pytest.mark.system
def test_release_is_whole_and_its_checksums_hold(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("config.yaml").write_text("studies: {one: {runs: [{height: 0.02, n_x: 40, n_y: 4}]}}")
    Path("results").mkdir()
    for name in release.SHOWN:
        Path("results", name).write_text(name)
    monkeypatch.setattr(bundle, "write", lambda archive, _: archive.write_bytes(b"results"))
    release.build(Path("out"), Path("config.yaml"))
    stem = f"{PROJECT['name']}-{PROJECT['version']}"
    names = {path.name for path in Path("out").iterdir()} - {release.CHECKSUMS}
    (wheel,) = (name for name in names if name.endswith(".whl"))
    assert wheel.startswith(f"{stem.replace('-', '_', stem.count('-') - 1)}-py3")
    assert names == {*release.SHOWN, wheel, f"{stem}-results.tar", f"{stem}-source.tar.gz"}
    check = ["sha256sum", "-c", "--strict", release.CHECKSUMS]
    told = subprocess.run(check, cwd="out", text=True, capture_output=True, check=True).stdout
    assert {line.partition(":")[0] for line in told.splitlines()} == names
    with tarfile.open(f"out/{stem}-source.tar.gz") as tar:
        assert f"{stem}/pyproject.toml" in tar.getnames()
    with pytest.raises(OSError):
        release.build(Path("out"), Path("config.yaml"))


def test_versions_agree():
    found = [CITED["version"], ZENODO["version"], CODEMETA["version"], nucleation.__version__]
    assert set(map(str, found)) == {PROJECT["version"]}
    changes = (ROOT / "CHANGELOG.md").read_text("utf-8")
    assert re.search(rf"^## {re.escape(PROJECT['version'])}\b", changes, re.M)


def test_metadata_agree():
    assert CITED["license"] == ZENODO["license"] == PROJECT["license"]
    assert CODEMETA["license"].endswith(f"/{PROJECT['license']}")
    assert CITED["title"] == ZENODO["title"] == CODEMETA["name"]
    assert CITED["keywords"] == ZENODO["keywords"] == CODEMETA["keywords"]
    assert CITED["abstract"] == ZENODO["description"] == CODEMETA["description"]
    assert len(CITED["authors"]) == len(ZENODO["creators"]) == len(CODEMETA["author"])
    doi = CITED["references"][0]["doi"]
    assert doi == ZENODO["related_identifiers"][0]["identifier"]
    assert CODEMETA["referencePublication"]["@id"] == f"https://doi.org/{doi}"
