"""Plans: a job on another machine makes what its own process has planned, whatever others plan."""

import dataclasses
import json
import os
from pathlib import Path
from types import SimpleNamespace

import pytest
from snakemake.io import IOCache

from replication.pipeline.planning import PLAN, Plan


class File(str):
    """A rule's file without wildcards."""

    def apply_wildcards(self, wildcards):
        return self


@dataclasses.dataclass
class Build:
    """A process that plans the result a.csv with one argument, and its jobs."""

    value: int
    locks: list[tuple[str, str]]
    results: str = "results"
    name: str = ""  # of its plan

    def plan(self, main):
        """The path of the recipe, as the process itself or a job of it finds it."""
        settings = {"forcerun": [], "targets": [], "forcetargets": False, "forceall": False}
        workflow = SimpleNamespace(
            is_main_process=main,
            executor_plugin="any",
            dryrun=False,
            touch=False,
            dag_settings=SimpleNamespace(**settings),
            persistence=SimpleNamespace(_read_locks=lambda: self.locks),
            iocache=IOCache(max_wait_time=10),
        )
        rule = SimpleNamespace(output=[File(f"{self.results}/a.csv")], input={})
        rule.params = {"call": "replication.pipeline.check:plain", "text": self.value}
        rule.rule = rule
        return Path(Plan(SimpleNamespace(a=rule), workflow, self.results)("a")({}))

    def planned(self):
        """Its recipe, once it has planned."""
        recipe = self.plan(main=True)
        self.name = os.environ[PLAN]
        return recipe

    def in_job(self, monkeypatch, value):
        """The argument in the recipe of a job, which reads another one in the configuration."""
        monkeypatch.setenv(PLAN, self.name)
        job = dataclasses.replace(self, value=value)
        return json.loads(job.plan(main=False).read_text())["values"]["text"]


OTHERS = ("output", "other/a.csv")
OWN = ("output", "results/b.csv")


@pytest.fixture(autouse=True)
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(PLAN, "")
    return tmp_path


@pytest.mark.parametrize("locks", [[], [OTHERS], [OWN], [OTHERS, OWN]])
def test_a_second_build_has_its_own_values(locks, monkeypatch):
    Build(1, []).planned()
    second = Build(2, locks)
    second.planned()
    assert second.in_job(monkeypatch, value=1) == 2


def test_a_build_keeps_its_values_while_another_one_plans(monkeypatch):
    first, second = Build(1, []), Build(2, [OWN])
    first.planned(), second.planned()
    assert first.in_job(monkeypatch, value=2) == 1


@pytest.mark.parametrize(("locks", "kept"), [([], False), ([OTHERS], False), ([OWN], True)])
def test_recipes_of_another_build_are_left_while_it_has_a_lock(locks, kept):
    recipe = Build(1, []).planned()
    Build(2, locks).planned()
    assert recipe.exists() == kept


@pytest.mark.parametrize(("age", "kept"), [(3600.0, True), (2 * 86_400.0, False)])
def test_old_plans_go_once_no_run_is_at_work(place, age, kept):
    first = Build(1, [])
    first.planned()
    (plan,) = place.rglob(first.name)
    written = plan.stat().st_mtime
    os.utime(plan, (written - age, written - age))
    Build(2, [OWN]).planned()
    assert plan.exists()
    Build(2, []).planned()
    assert plan.exists() == kept


def test_a_job_that_is_not_told_its_plan_says_what_to_do(monkeypatch):
    first = Build(1, [])
    first.planned()
    monkeypatch.delenv(PLAN)
    with pytest.raises(SystemExit, match="NUCLEATION_PLAN is not set: let the scheduler pass on"):
        first.plan(main=False)
