"""The workflow runs with the oldest Snakemake that pyproject.toml allows."""

import os
import re
import subprocess
import sysconfig
import tomllib
import venv
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
EXTRAS = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
(OLDEST,) = (m[1] for m in map(re.compile(r"snakemake>=([\d.]+)").match, EXTRAS["workflow"]) if m)
SHORT = {"n_x": 40, "n_y": 3, "tolerance": 5e-2, "longest_step": 0.5, "end_time": 0.1}


def run(*command, **options):
    return subprocess.run(
        [str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True, timeout=600, **options,
    )  # fmt: skip


@pytest.fixture
def oldest(tmp_path):
    """A Python with that version, and of all else what is here."""
    venv.create(tmp_path / "environment", with_pip=True)
    base = {"base": str(tmp_path / "environment"), "platbase": str(tmp_path / "environment")}
    others = Path(sysconfig.get_path("purelib", vars=base)) / "others.pth"
    others.write_text(sysconfig.get_path("purelib") + "\n")
    python = tmp_path / "environment" / "bin" / "python"
    pip = run(python, "-m", "pip", "--quiet", "install", f"snakemake=={OLDEST}")
    if pip.returncode != 0 and os.environ.get("CI") != "true":
        pytest.skip("no packages can be installed here")
    assert pip.returncode == 0, pip.stdout
    found = run(python, "-c", "import importlib.metadata as m; print(m.version('snakemake'))")
    assert found.stdout.startswith(OLDEST)
    return python


def test_the_snakefile_asks_for_it():
    assert f'min_version("{OLDEST}")' in (ROOT / "Snakefile").read_text()


@pytest.mark.slow
def test_small_study(oldest, tmp_path):
    study = {"length_over_critical": 4.0, "defaults": SHORT,
             "runs": [{"height": [0.01, 0.02, 0.03]}]}  # fmt: skip
    batches = study | {"runs_per_job": 2, "runs": [{"height": [0.04, 0.05]}]}
    config = tmp_path / "config.yaml"
    config.write_text(yaml.safe_dump({"studies": {"mine": study, "many": batches}}))
    command = [oldest, "-m", "snakemake", "lengths", "--snakefile", ROOT / "Snakefile",
               "--workflow-profile", ROOT / "profiles/default",
               "--configfile", config]  # fmt: skip
    given = {"cwd": tmp_path, "env": {**os.environ, "PYTHONPATH": str(ROOT / "src")}}
    planned = run(*command, "--dry-run", **given)
    assert planned.returncode == 0, planned.stdout
    assert re.search(r"^simulate +3$", planned.stdout, re.M), planned.stdout
    done = run(*command, **given)
    assert done.returncode == 0, done.stdout
    assert len((tmp_path / "results/lengths.csv").read_text().splitlines()) == 6
    again = run(*command, "--dry-run", **given)
    assert not re.search(r"^(simulate|batch|extract) ", again.stdout, re.M), again.stdout
