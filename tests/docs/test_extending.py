"""docs/extending.md carried out in a copy of the project: law, test, study and figure."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from docs.samples import ROOT, commands, samples
from numba.core.caching import UserProvidedCacheLocator
from warm_snakemake import warm

from replication.pipeline.launch import cache_of_numba

pytestmark = pytest.mark.system

PAGE = ROOT / "docs" / "extending.md"


def run(arguments, checkout):
    done = subprocess.run(
        [sys.executable, "-m", *arguments],
        cwd=checkout,
        stdin=subprocess.DEVNULL,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=600,
        env={**os.environ, "PYTHONPATH": str(checkout / "src")},
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


place = UserProvidedCacheLocator.get_suitable_cache_subpath
ADDED = ["src/nucleation/model/friction/evolutions/halfway.py"]
ADDED += ["src/replication/figures/figure_laws.py", "src/replication/tables/by_law.py"]


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """A copy of the project with the page's additions."""
    copy = tmp_path_factory.mktemp("checkout")
    parts = ("Snakefile", "pyproject.toml", "src", "workflow", "config", "profiles")
    for part in (*parts, "tests/model/test_laws.py"):
        (copy / part).parent.mkdir(parents=True, exist_ok=True)
        take = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        take(ROOT / part, copy / part)
    for sample in filter(lambda sample: sample.file, samples(PAGE)):
        path = copy / sample.file
        before = path.read_text() + "\n\n" if path.exists() else ""
        path.write_text(before + sample.code)
    kept, own = (cache_of_numba(root / "src" / "nucleation") for root in (ROOT, copy))
    for file in (ROOT / "src").rglob("*.py"):  # compiled code is found by its file's path
        old, new = (kept / place(file), own / place(copy / file.relative_to(ROOT)))
        if old.is_dir():
            shutil.copytree(old, new, dirs_exist_ok=True)
    return copy


def test_laws_pass_the_tests_of_all_laws(checkout):
    command = ["pytest", "tests/model/test_laws.py", "-k", "halfway", "-p", "no:cacheprovider"]
    done = re.search(r"(\d+) passed", run(command, checkout))
    assert int(done[1]) > 10


def test_additions_are_in_style(checkout):
    run(["ruff", "check", *ADDED], checkout)
    run(["ruff", "format", "--check", *ADDED], checkout)


def test_study_figure_and_table(checkout):
    """The page's last command carried out; the table is made from its lengths."""
    *_, (_, command) = commands(samples(PAGE))
    program, *arguments = command.split()
    assert program == ".venv/bin/snakemake"
    done = warm()([*arguments, "--cores", "1"], checkout, checkout / "printed")  # one core compiles
    assert done.returncode == 0, done.stdout
    results = checkout / "results" / "laws"
    assert (results / "figures" / "figure_laws.png").stat().st_size > 10_000
    table = pd.read_csv(results / "lengths.csv")
    spec = importlib.util.spec_from_file_location("replication.tables.by_law", checkout / ADDED[2])
    by_law = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(by_law)
    with xr.open_dataset(results / "lengths.nc") as lengths:
        means = by_law.by_law(lengths.load()).to_dataframe().set_index("evolution")
    assert means["runs"].to_dict() == {"aging": 2, "halfway": 3}
    ratio = (table["length"] / table["critical_length"]).groupby(table["evolution"]).mean()
    assert np.allclose(means["mean_ratio"], ratio)
    table["friction"] = np.where(table["id"].str.contains("dieterich_ruina"), "other", "paper")
    by_law = table.set_index(["friction", "height", "evolution"])["length"]
    assert by_law.notna().all() and by_law.index.is_unique
    paper, other = by_law["paper"].unstack(), by_law["other"].unstack()
    assert set(paper) == {"aging", "halfway"} and set(other) == {"halfway"}
    assert (paper["halfway"] != paper["aging"]).all()
    for ratio in (paper["halfway"] / paper["aging"], other["halfway"] / paper["halfway"].loc[0.02]):
        assert ratio.between(0.7, 1.4).all()
