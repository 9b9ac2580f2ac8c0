"""An archive of all results: nothing is computed again after it is restored, whoever takes it."""

import dataclasses
import shutil
import tarfile

import pytest
import yaml

from replication.pipeline import bundle

RESULTS = "results/quick"


@pytest.fixture(scope="module")
def archive(quick, tmp_path_factory):
    """An archive of results that were moved."""
    moved = tmp_path_factory.mktemp("bundle")
    shutil.copytree(quick.directory / RESULTS, moved / RESULTS, symlinks=True)
    bundle.write(moved / "results.tar", quick.config, moved)
    return moved / "results.tar"


def shown(directory):
    """Contents of all that people open, by name."""
    results = directory / RESULTS
    return {
        str(path.relative_to(results)): path.read_bytes()
        for path in results.rglob("*")
        if path.is_symlink()
    }


def test_nothing_is_computed_again_after_restoring(quick, archive, tmp_path):
    """Nor is anything that a changed parameter does not reach; what people open is the same."""
    bundle.restore(archive, RESULTS, tmp_path)
    restored = dataclasses.replace(quick, directory=tmp_path)
    assert restored.planned() == {}
    values = yaml.safe_load(quick.config.read_text())
    values["extraction"] = {**values.get("extraction", {}), "edge_threshold": 0.2}
    planned = restored.configured(values, "changed.yaml").planned()
    assert "extract" in planned and "simulate" not in planned
    done = restored()
    assert done.returncode == 0, done.stdout
    assert shown(tmp_path) == shown(quick.directory) and len(shown(tmp_path)) > 10
    assert "All is current" in restored("check").stdout


def test_archive_unpacked_by_tar_has_the_figures_and_is_a_store(
    quick, archive, tmp_path, monkeypatch
):
    with tarfile.open(archive) as tar:
        tar.extractall(tmp_path / "unpacked", filter="data")
    files = {str(p.relative_to(tmp_path / "unpacked")): p for p in tmp_path.rglob("*.*")}
    for name, content in shown(quick.directory).items():
        assert name.endswith(".nc") or files[name].read_bytes() == content
    monkeypatch.setenv("NUCLEATION_STORES", str(tmp_path / "unpacked" / "store"))
    clone = dataclasses.replace(quick, directory=tmp_path / "clone")
    clone.directory.mkdir()
    done = clone("figure_1")
    assert done.returncode == 0, done.stdout
    assert "Shown without a job: 1 results, 1 of them taken from other stores" in done.stdout
