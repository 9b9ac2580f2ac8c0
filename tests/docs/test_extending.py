"""docs/extending.md carried out in a copy of the project: law, test, study and figure."""

import os
import shutil
import subprocess
import sys

import pandas as pd
import pytest
from docs.samples import ROOT, commands, samples

PAGE = ROOT / "docs" / "extending.md"


def run(arguments, checkout):
    done = subprocess.run(
        [sys.executable, "-m", *arguments], cwd=checkout, stdin=subprocess.DEVNULL, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600,
        env={**os.environ, "PYTHONPATH": str(checkout / "src")},
    )  # fmt: skip
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """A copy of the project with the page's additions."""
    copy = tmp_path_factory.mktemp("checkout")
    parts = ("Snakefile", "pyproject.toml", "src", "workflow", "config")
    for part in (*parts, "tests/model/test_friction.py"):
        (copy / part).parent.mkdir(parents=True, exist_ok=True)
        take = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        take(ROOT / part, copy / part)
    added = {}
    for sample in filter(lambda sample: sample.file, samples(PAGE)):
        path = copy / sample.file
        if sample.language == "diff":
            lines = sample.code.splitlines()
            removed = "".join(line[1:] + "\n" for line in lines if line.startswith("-"))
            new = "".join(line[1:] + "\n" for line in lines if line.startswith("+"))
            text = path.read_text()
            assert text.count(removed) == 1  # the page shows the line as it is
            path.write_text(text.replace(removed, added.pop(sample.file) + "\n\n" + new))
        elif path.name == "evolution.py":
            added[sample.file] = sample.code  # goes above the line that the next sample changes
        else:
            before = path.read_text() + "\n\n" if path.exists() else ""
            path.write_text(before + sample.code)
    assert not added
    return copy


def test_law_passes_its_test(checkout):
    command = ["pytest", "tests/model/test_friction.py", "-k", "halfway"]
    assert "3 passed" in run([*command, "-p", "no:cacheprovider"], checkout)


def test_additions_are_in_style(checkout):
    paths = ["src/nucleation/model/friction/evolution.py"]
    paths += ["src/nucleation/figures/beyond/figure_laws.py"]
    paths += ["tests/model/test_friction.py", "workflow/scripts/figure_laws.py"]
    run(["ruff", "check", *paths], checkout)
    run(["ruff", "format", "--check", *paths], checkout)


def test_study_and_figure(checkout):
    """The page's last command, which needs everything before it."""
    *_, (_, command) = commands(samples(PAGE))
    program, *arguments = command.split()
    assert program == ".venv/bin/snakemake"
    run(["snakemake", *arguments], checkout)
    results = checkout / "results" / "laws"
    assert (results / "figures" / "figure_laws.png").stat().st_size > 10_000
    table = pd.read_csv(results / "lengths.csv")
    assert sorted(table["law"]) == ["aging"] * 2 + ["halfway"] * 2
    assert table["length"].notna().all()
    by_law = table.set_index(["height", "law"])["length"].unstack()
    assert (by_law["halfway"] != by_law["aging"]).all()
    assert (by_law["halfway"] / by_law["aging"]).between(0.7, 1.4).all()
