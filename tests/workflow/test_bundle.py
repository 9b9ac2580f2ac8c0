"""A bundle of all results: whole, verified, and nothing computed again after it is restored."""

import dataclasses
import io
import shutil
import tarfile

import pytest
import yaml

from nucleation.pipeline import bundle
from nucleation.pipeline.bundle import BundleError


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


def test_nothing_is_computed_again_after_restoring(quick, archive, tmp_path):
    bundle.restore(archive, tmp_path)
    restored = dataclasses.replace(quick, directory=tmp_path)
    assert files_below(tmp_path) == files_below(quick.directory)
    assert not list(tmp_path.glob(".restore-*"))
    done = restored()
    assert done.returncode == 0 and "Nothing to be done" in done.stdout, done.stdout
    assert "All is current" in restored("check").stdout


def test_change_after_restoring_runs_what_depends_on_it(quick, archive, tmp_path):
    """Snakemake's notes come with the results."""
    bundle.restore(archive, tmp_path)
    values = yaml.safe_load(quick.config.read_text())
    values["extraction"] = {**values.get("extraction", {}), "edge_threshold": 0.2}
    changed = dataclasses.replace(quick, directory=tmp_path).configured(values)
    assert "extract" in changed.planned() and "simulate" not in changed.planned()


def test_manifest_names_every_result(quick, archive):
    with tarfile.open(archive) as tar:
        manifest = yaml.safe_load(tar.extractfile("codecheck.yml"))
        assert all(member.isfile() for member in tar), "links are followed"
    named = {entry["file"] for entry in manifest["manifest"]}
    assert named == set(files_below(quick.directory))
    assert manifest["paper"]["reference"].endswith("10.1002/2017GL074939")


def test_links_into_a_cache_become_files(quick, tmp_path):
    shutil.copytree(quick.directory / "results", tmp_path / "results")
    results = tmp_path / "results" / "quick"
    kept = (results / "theory.nc").rename(tmp_path / "entry.nc")
    (results / "theory.nc").symlink_to(kept)
    bundle.write(tmp_path / "out.tar", quick.config, tmp_path)
    bundle.restore(tmp_path / "out.tar", tmp_path / "clone")
    restored = tmp_path / "clone" / "results" / "quick" / "theory.nc"
    assert not restored.is_symlink() and restored.read_bytes() == kept.read_bytes()


def test_nothing_is_overwritten(quick, archive, tmp_path):
    with pytest.raises(BundleError, match="exists already"):
        bundle.write(archive, quick.config, quick.directory)
    bundle.restore(archive, tmp_path)
    assert bundle.restore(archive, tmp_path) == 0
    path = tmp_path / "results" / "quick" / "lengths.csv"
    path.write_text("mine")
    with pytest.raises(BundleError, match=r"lengths\.csv and 0 other files are here already"):
        bundle.restore(archive, tmp_path)
    assert path.read_text() == "mine"


def test_no_results_no_bundle(quick, tmp_path):
    with pytest.raises(BundleError, match="no results"):
        bundle.write(tmp_path / "out.tar", quick.config, tmp_path)
    assert not list(tmp_path.iterdir())
    with pytest.raises(BundleError, match="does not exist"):
        bundle.restore(tmp_path / "out.tar", tmp_path)


@pytest.mark.parametrize("name", ["config.yaml", bundle.CHECKSUMS, "results/quick/lengths.nc"])
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
        bundle.restore(path, directory / "clone")
    assert not list((directory / "clone").iterdir())


def test_archive_can_not_write_elsewhere(tmp_path):
    path = tmp_path / "evil.tar"
    with tarfile.open(path, "w") as tar:
        for name, text in (("../outside", "x"), (bundle.CHECKSUMS, "0" * 64 + "  ../outside\n")):
            entry = tarfile.TarInfo(name)
            entry.size = len(text)
            tar.addfile(entry, io.BytesIO(text.encode()))
    with pytest.raises(BundleError):
        bundle.restore(path, tmp_path / "clone")
    assert not (tmp_path / "outside").exists()
