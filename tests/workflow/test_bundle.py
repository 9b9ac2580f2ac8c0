"""A bundle of all results: whole, verified, and nothing computed again after it is restored."""

import dataclasses
import hashlib
import json
import shutil
import tarfile

import pytest
import yaml

from nucleation.pipeline import bundle
from nucleation.pipeline.archives import CHECKSUMS, BundleError

RESULTS = "results/quick"


@pytest.fixture(scope="module")
def archive(quick, tmp_path_factory):
    path = tmp_path_factory.mktemp("bundle") / "results.tar"
    bundle.write(path, quick.config, quick.directory)
    return path


def files_below(directory):
    return {
        str(path.relative_to(directory)): path.read_bytes()
        for path in (directory / "results").rglob("*")
        if path.is_file()
    }


def results_below(directory):
    """Names of the results, without the records that vouch for them."""
    return {name for name in files_below(directory) if "/.made/" not in name}


def test_nothing_is_computed_again_after_restoring(quick, archive, tmp_path):
    bundle.restore(archive, RESULTS, tmp_path)
    restored = dataclasses.replace(quick, directory=tmp_path)
    assert files_below(tmp_path) == files_below(quick.directory)
    assert not list(tmp_path.glob(".restore-*"))
    done = restored()
    assert done.returncode == 0 and "Nothing to be done" in done.stdout, done.stdout
    assert "All is current" in restored("check").stdout


def test_change_after_restoring_runs_what_depends_on_it(quick, archive, tmp_path):
    """Snakemake's notes come with the results."""
    bundle.restore(archive, RESULTS, tmp_path)
    values = yaml.safe_load(quick.config.read_text())
    values["extraction"] = {**values.get("extraction", {}), "edge_threshold": 0.2}
    changed = dataclasses.replace(quick, directory=tmp_path).configured(values)
    assert "extract" in changed.planned() and "simulate" not in changed.planned()


def test_manifest_names_every_result(quick, archive):
    with tarfile.open(archive) as tar:
        manifest = yaml.safe_load(tar.extractfile("codecheck.yml"))
        assert all(member.isfile() for member in tar), "links are followed"
    named = {entry["file"] for entry in manifest["manifest"]}
    assert named == results_below(quick.directory)
    assert manifest["paper"]["reference"].endswith("10.1002/2017GL074939")


def test_links_into_a_cache_become_files(quick, tmp_path):
    shutil.copytree(quick.directory / "results", tmp_path / "results")
    results = tmp_path / "results" / "quick"
    kept = (results / "theory.nc").rename(tmp_path / "entry.nc")
    (results / "theory.nc").symlink_to(kept)
    bundle.write(tmp_path / "out.tar", quick.config, tmp_path)
    bundle.restore(tmp_path / "out.tar", RESULTS, tmp_path / "clone")
    restored = tmp_path / "clone" / "results" / "quick" / "theory.nc"
    assert not restored.is_symlink() and restored.read_bytes() == kept.read_bytes()


def test_nothing_is_overwritten(quick, archive, tmp_path):
    with pytest.raises(BundleError, match="exists already"):
        bundle.write(archive, quick.config, quick.directory)
    bundle.restore(archive, RESULTS, tmp_path)
    assert bundle.restore(archive, RESULTS, tmp_path) == 0
    path = tmp_path / "results" / "quick" / "lengths.csv"
    path.write_text("mine")
    with pytest.raises(BundleError, match=r"lengths\.csv and 0 other files are here already"):
        bundle.restore(archive, RESULTS, tmp_path)
    assert path.read_text() == "mine"


def test_no_results_no_bundle(quick, tmp_path):
    with pytest.raises(BundleError, match="no results"):
        bundle.write(tmp_path / "out.tar", quick.config, tmp_path)
    assert not list(tmp_path.iterdir())
    with pytest.raises(BundleError, match="does not exist"):
        bundle.restore(tmp_path / "out.tar", RESULTS, tmp_path)


@pytest.mark.parametrize("name", ["config.yaml", CHECKSUMS, "results/quick/lengths.nc"])
def test_damaged_archive_puts_nothing_in_place(archive, tmp_path, name):
    with tarfile.open(archive) as tar:
        member = tar.getmember(name)
    whole = archive.read_bytes()
    flipped = bytearray(whole)
    flipped[member.offset_data + member.size // 2] ^= 4
    _refused(flipped, tmp_path)
    _refused(whole[: member.offset_data + member.size // 2], tmp_path)


def _refused(content, directory):
    path = directory / "damaged.tar"
    path.write_bytes(content)
    with pytest.raises(BundleError, match="damaged"):
        bundle.restore(path, RESULTS, directory / "clone")
    assert not list((directory / "clone").iterdir())


@pytest.fixture(scope="module")
def crate(archive):
    """The entities of the description as a research object, by their names."""
    with tarfile.open(archive) as tar:
        described = json.load(tar.extractfile("ro-crate-metadata.json"))
    assert described["@context"][0] == "https://w3id.org/ro/crate/1.1/context"
    entities = {entity["@id"]: entity for entity in described["@graph"]}
    assert len(entities) == len(described["@graph"]), "a name stands for one entity"
    return entities


def references(value):
    """All references in an entity, wherever they stand."""
    if isinstance(value, dict):
        return [value["@id"]] if value.keys() == {"@id"} else references(list(value.values()))
    return [name for part in value for name in references(part)] if isinstance(value, list) else []


def test_research_object_meets_the_specification(crate):
    """What RO-Crate 1.1 says that must be: its sections on the root, on files, and on contexts."""
    descriptor, root = crate["ro-crate-metadata.json"], crate["./"]
    assert descriptor["@type"] == "CreativeWork" and descriptor["about"] == {"@id": "./"}
    assert descriptor["conformsTo"] == {"@id": "https://w3id.org/ro/crate/1.1"}
    assert root["@type"] == "Dataset"
    assert all(root[key] for key in ("name", "description", "datePublished", "license", "hasPart"))
    for entity in crate.values():
        assert entity["@type"], entity
        assert not [key for key, value in entity.items() if value is None], entity
    named = {name for entity in crate.values() for name in references(entity)}
    assert named - {"https://w3id.org/ro/crate/1.1"} <= crate.keys(), "all that is named is there"
    assert crate.keys() - named == {"ro-crate-metadata.json"}, "all that is there is named"


def test_research_object_names_files_code_parameters_and_paper(quick, archive, crate):
    files = {name: entity for name, entity in crate.items() if entity["@type"] == "File"}
    assert {entity["@id"] for entity in crate["./"]["hasPart"]} == files.keys()
    results = results_below(quick.directory)
    assert files.keys() == {*results, "config.yaml", "codecheck.yml"}
    for name, content in files_below(quick.directory).items():
        if name not in results:
            continue
        assert files[name]["sha256"] == hashlib.sha256(content).hexdigest()
        assert files[name]["contentSize"] == str(len(content))
    formats = {name.rpartition(".")[2]: file["encodingFormat"] for name, file in files.items()}
    assert formats["nc"] == "application/x-netcdf" and formats["pdf"] == "application/pdf"
    assert crate["#material.shear_modulus"]["unitText"] == "Pa"
    assert crate["#code"]["version"] and crate["#numpy"]["version"]
    assert crate["./"]["license"] == {"@id": "https://spdx.org/licenses/MIT"}
    (paper,) = crate["./"]["citation"]
    assert paper["@id"] == "https://doi.org/10.1002/2017GL074939"
    assert crate[crate[paper["@id"]]["author"][0]["@id"]]["name"] == "Michael Aldam"


def test_only_results_are_packed(quick, tmp_path):
    """A file of the user's among the results stays out, as it could not come out again."""
    shutil.copytree(quick.directory / "results", tmp_path / "results")
    for name in ("notes.py", ".hidden.csv"):
        (tmp_path / RESULTS / name).write_text("mine")
    (tmp_path / RESULTS / "secret.csv").symlink_to(tmp_path / RESULTS / "notes.py")
    bundle.write(tmp_path / "out.tar", quick.config, tmp_path)
    with tarfile.open(tmp_path / "out.tar") as tar:
        assert not {"notes.py", ".hidden.csv", "secret.csv"} & {
            name.rpartition("/")[2] for name in tar.getnames()
        }


def test_results_elsewhere_are_refused(quick, tmp_path):
    values = yaml.safe_load(quick.config.read_text()) | {"results": str(tmp_path / "away")}
    (tmp_path / "config.yaml").write_text(yaml.safe_dump(values))
    with pytest.raises(BundleError, match="lies outside of the directory of the workflow"):
        bundle.write(tmp_path / "out.tar", tmp_path / "config.yaml", tmp_path)
