"""Running the workflow of this checkout, with results below a directory of the test's own."""

import dataclasses
import functools
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml
from once import once
from warm_snakemake import warm

ROOT = Path(__file__).parents[2]


@functools.cache
def makers(checkout: Path) -> set[str]:
    """The rules of a checkout that make results, or are a host's; the others are targets."""
    rules = "".join(
        path.read_text() for path in [*ROOT.glob("workflow/rules/*.smk"), checkout / "Snakefile"]
    )
    parts = re.split(r"^rule (\w+):$", rules, flags=re.M)
    return {name for name, text in zip(parts[1::2], parts[2::2], strict=True) if "output:" in text}


@dataclasses.dataclass(frozen=True)
class Workflow:
    """A checkout of the project and a directory in which its workflow runs."""

    directory: Path
    checkout: Path = ROOT
    config: Path = ROOT / "config" / "quick.yaml"
    profile: str = "default"

    def arguments(self, *arguments: str) -> list[str]:
        """What Snakemake is told: targets before options."""
        return [
            *arguments,
            "--snakefile",
            str(self.checkout / "Snakefile"),
            "--workflow-profile",
            str(self.checkout / "profiles" / self.profile),
            "--directory",
            str(self.directory),
            "--configfile",
            str(self.config),
        ]

    def start(self, *arguments: str, until: Callable = lambda: True) -> subprocess.Popen:
        """Start snakemake, which leads a group of processes, and wait for a moment in its run.

        Its output comes from ``stdout``.
        """
        process = subprocess.Popen(
            [sys.executable, "-m", "snakemake", *self.arguments(*arguments)],
            cwd=self.checkout,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        while not until():
            time.sleep(0.02)
            assert process.poll() is None
        return process

    def __call__(self, *arguments: str) -> subprocess.CompletedProcess:
        """Run snakemake; its whole output is in ``stdout``."""
        with tempfile.TemporaryDirectory() as place:
            return warm()(self.arguments(*arguments), self.checkout, Path(place, "printed"))

    def printed(self, *arguments: str) -> str:
        """What Snakemake prints, if it ends well."""
        done = self(*arguments)
        assert done.returncode == 0, done.stdout
        return done.stdout

    def planned(self, *arguments: str) -> dict[str, int]:
        """The jobs that a run would start, by their rules, from a dry run; not the targets' own.

        Those whose results a store has are listed, and a run needs no job for them.
        """
        printed = self.printed(*arguments, "--dry-run", "--quiet", "rules")
        if "Nothing to be done" in printed:
            return {}
        kept = re.search(r"as a store has their results: (.*)", printed)
        table = re.search(r"Job stats:\njob +count\n-+ +-+\n(.*?)\ntotal", printed, re.S)
        assert table, printed
        counts = Counter({rule: int(n) for rule, n in map(str.split, table[1].splitlines())})
        for rule, count in re.findall(r"(\w+) (\d+)", kept[1] if kept else ""):
            counts[rule] -= min(int(count), counts[rule])
        own = makers(self.checkout)
        return {
            rule: count
            for rule, count in counts.items()
            if count and rule.removeprefix("fault_") in own
        }

    def dataset(self, kind: str, id: str, results: str = "results/quick") -> Path:
        """The dataset of a kind and a run that is shown: the file in the store, by its own path."""
        return (self.directory / results / kind / f"{id}.nc").resolve(strict=True)

    def configured(self, config: object, name: str = "config.yaml") -> "Workflow":
        """The same with another configuration, given as text or as plain dictionaries."""
        path = self.directory / name
        path.write_text(
            config if isinstance(config, str) else yaml.safe_dump(config, sort_keys=False)
        )
        return dataclasses.replace(self, config=path)


@pytest.fixture(scope="session")
def workflow_type() -> type[Workflow]:
    """The class itself, for workflows that several tests share."""
    return Workflow


@pytest.fixture
def workflow(tmp_path: Path) -> Workflow:
    """The workflow with no results yet."""
    return Workflow(tmp_path)


@pytest.fixture(scope="session")
def quick(tmp_path_factory: pytest.TempPathFactory) -> Workflow:
    """The workflow after the quick configuration was run from nothing to all figures.

    It is run once; each worker gets a copy.
    """

    def make(directory: Path) -> None:
        directory.mkdir()
        Workflow(directory).printed()

    made, own = once(tmp_path_factory, "quick-workflow", make), tmp_path_factory.mktemp("quick")
    shutil.copytree(made, own, symlinks=True, dirs_exist_ok=True)
    return Workflow(own)


@pytest.fixture
def checkout(quick, tmp_path):
    """A copy of the project to edit, over the results of the quick configuration."""
    parts = ("Snakefile", "src", "workflow", "config", "docs", "profiles", "CITATION.cff")
    for part in parts:
        source = ROOT / part
        copy = shutil.copytree if source.is_dir() else shutil.copy2
        copy(source, tmp_path / part)
    return dataclasses.replace(quick, checkout=tmp_path)
