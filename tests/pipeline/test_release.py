"""A release: its parts, its checksums, and metadata that agree with the project's."""

import json
import re
import subprocess
import sys
import tarfile
import tomllib
from pathlib import Path

import pytest
import yaml

import nucleation

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
CITED = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
ZENODO = json.loads((ROOT / ".zenodo.json").read_text("utf-8"))
CODEMETA = json.loads((ROOT / "codemeta.json").read_text("utf-8"))


BUNDLES = """#!/bin/sh
case "$*" in *pipeline.bundle*) touch "$4" ;; *) exec '{python}' "$@" ;; esac
"""


@pytest.mark.slow
@pytest.mark.system
def test_release_is_whole_and_its_checksums_hold(tmp_path):
    python, results = tmp_path / "python", tmp_path / "my results"
    out = tmp_path / "out `touch PWN` it's"
    python.write_text(BUNDLES.format(python=sys.executable))
    python.chmod(0o755)
    results.mkdir()
    shown = {"replication.pdf", "replication.tex", "report.html"}
    for name in shown:
        (results / name).write_text(name)
    places = {"BIN": tmp_path, "RESULTS": results, "RELEASE": out}
    command = ["make", "released", *(f"{name}={path}" for name, path in places.items())]
    subprocess.run(command, cwd=ROOT, check=True)
    stem = f"{PROJECT['name']}-{PROJECT['version']}"
    names = {path.name for path in out.iterdir()} - {"SHA256SUMS"}
    (wheel,) = (name for name in names if name.endswith(".whl"))
    assert wheel.startswith(f"{stem.replace('-', '_', stem.count('-') - 1)}-py3")
    assert names == {*shown, wheel, f"{stem}-results.tar", f"{stem}-source.tar.gz"}
    check = ["sha256sum", "-c", "--strict", "SHA256SUMS"]
    told = subprocess.run(check, cwd=out, text=True, capture_output=True, check=True).stdout
    assert {line.partition(":")[0] for line in told.splitlines()} == names
    with tarfile.open(out / f"{stem}-source.tar.gz") as tar:
        assert f"{stem}/pyproject.toml" in tar.getnames()
    assert not (ROOT / "PWN").exists()
    assert subprocess.run(command, cwd=ROOT, capture_output=True).returncode != 0


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
