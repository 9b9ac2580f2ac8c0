"""Planning: the recipe of each result, and whether the result is there already.

Each rule has its recipe (:mod:`.recipes`) as one more input, a file below the store with the key in
its name. The process that plans writes it: as old as a file can be if the rule's outputs show the
result of that recipe, otherwise with new content and newer than the outputs. So Snakemake's own
triggers decide correctly, even if its notes are lost or times of files are wrong; and what another
process plans has other names. A plan belongs to its process: the keys are in a file of its own, and
the environment tells jobs on other machines its name.

A run, unlike a dry run, first removes files that show another result, so that none is left if a job
fails, and shows all results that are in a store. While another run has a lock on these results
Snakemake may refuse this one, so it does so later, at its start. Snakemake's inner parts are used
here alone.
"""

import atexit
import contextlib
import hashlib
import os
import socket
import time
from collections import Counter
from collections.abc import Callable, Mapping
from functools import cached_property
from inspect import signature
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from . import LOGGER, recipes
from .job import FORCED
from .recipes import Recipe, listed, withdraw, write
from .store import NOTE, Store, others

PLAN = "NUCLEATION_PLAN"
"""Environment variable with the name of the file of a plan, beside the recipes."""

_PLANS = "planned-*"  # files with the names and keys of the jobs of a run
_KEPT = 86_400.0  # s for which they stay at least: a run that still plans has no lock yet

Paths = Any  # one path, or several in a list, as Snakemake's texts or plain ones


class Plan:
    """The recipes of a workflow: its rules by name, Snakemake's workflow, and where results go."""

    def __init__(self, rules: Any, workflow: Any, results: str) -> None:
        self._rules = rules  # each is read when it is used, so its definition may come later
        self._workflow = workflow
        self._configured = results
        self._names: list[str] = []  # of the rules that make results
        self._known: dict[tuple[str, ...], Recipe] = {}
        self._inputs: dict[str, list[str]] = {}  # by the name of the result
        self._files: dict[str, Any] = {}  # Snakemake's files by their paths
        self._kept: Counter[str] = Counter()  # jobs of a dry run that a run would not start
        self.checked = False  # whether the workflow fails at its end unless all is current
        self._waiting: list[Recipe] = []  # whose files were not updated before the start
        self._shown = self._taken = 0  # results that a run showed, and took from other stores
        if workflow.is_main_process:
            process = f"{socket.gethostname()}-{os.getpid()}-{time.time_ns()}"
            os.environ[PLAN] = _PLANS.replace("*", process)
        atexit.register(self._report)

    def __call__(self, rule: str) -> Callable[[Any], str]:
        """The input function of a rule; it returns the path of the recipe's file."""
        self._names.append(rule)

        def recipe_file(wildcards: Any) -> str:
            try:
                return self._file_of(rule, dict(wildcards.items())).removeprefix(self.prefix)
            except Exception as error:  # else Snakemake would use an outdated file of the result
                raise SystemExit(f"{rule} can't be planned: {error}") from None

        recipe_file.__signature__ = signature(recipe_file)  # type: ignore[attr-defined]
        return recipe_file

    def _report(self) -> None:
        kept = ", ".join(f"{rule} {count}" for rule, count in self._kept.items() if count)
        if kept:
            LOGGER.info(f"Of these jobs a run starts none, as a store has their results: {kept}")
        if self._shown:
            taken = f"{self._taken} of them taken from other stores"
            LOGGER.info(f"Shown without a job: {self._shown} results, {taken}")

    def start(self) -> None:
        """Once Snakemake has its lock, remove files that show another result than was planned."""
        while self._waiting:
            self._update_views(self._waiting.pop())

    @cached_property
    def prefix(self) -> str:
        """The ``prefix:`` of a module, which Snakemake puts before all paths of its rules."""
        first = getattr(self._rules, self._names[0]).output[0]
        if getattr(first, "is_storage", False):
            raise ValueError("results are links, which no storage keeps: use NUCLEATION_STORES")
        before, found, _ = str(first).partition(self._configured)
        if found:
            return before
        raise ValueError(f"{first} is not in {self._configured}: use prefix, not replace_prefix")

    @cached_property
    def results(self) -> str:
        """The directory of results for Snakemake, with the prefix of a module."""
        return self.prefix + self._configured

    @cached_property
    def store(self) -> Store:
        """The store of the results."""
        return Store(f"{self.results}/store")

    @cached_property
    def _others(self) -> list[Store]:
        return others(strict=False)

    @cached_property
    def _place(self) -> str:
        """The directory of the recipes in the store; directories of results may share a store."""
        mark = hashlib.sha256(recipes.places_of(self.results).encode()).hexdigest()[:8]
        return f"{self.store.directory}/{recipes.RECIPES}/{mark}"

    @cached_property
    def _beside_a_run(self) -> bool:
        """Whether another run, at work or killed, has a lock on files of these results."""
        results = os.path.abspath(self.results)
        locks = self._workflow.persistence._read_locks()
        return any(os.path.abspath(path).startswith(f"{results}/") for _, path in locks)

    @cached_property
    def runs(self) -> bool:
        """Whether jobs may run; then they learn which results are forced, and have a plan."""
        workflow = self._workflow
        if workflow.executor_plugin is None or workflow.dryrun or workflow.touch:
            return False
        asked = workflow.dag_settings
        forced = {*asked.forcerun, *(asked.targets if asked.forcetargets else ())}
        os.environ[FORCED] = "*" if asked.forceall else "\n".join(map(str, forced))
        write(self._plan, "")
        write(Path(self._place, recipes.PLACES), recipes.places_of(self.results))
        return True

    @cached_property
    def _changes(self) -> bool:
        """Whether files that people open, and other recipes, may be changed before any job.

        If another run is at work, Snakemake may stop later, and it may need them.
        """
        if not self.runs or self._beside_a_run:
            return False
        for plan in Path(self._place).glob(_PLANS):
            if recipes.time_of(str(plan)) < time.time() - _KEPT:
                plan.unlink(missing_ok=True)
        return True

    @cached_property
    def _plan(self) -> Path:
        """The file with the names and keys of the jobs of this process's run."""
        if PLAN not in os.environ:
            raise ValueError(f"{PLAN} is not set: let the scheduler pass on the environment")
        return Path(self._place, os.environ[PLAN])

    @cached_property
    def _written(self) -> dict[str, set[str]]:
        return recipes.written_in(self._place)

    @cached_property
    def _makers(self) -> tuple[dict[str, str], list[tuple[Any, str]]]:
        """Rules by their files, and pairs of a pattern with wildcards and its rule."""
        # the proxy of a rule lacks the constraints of wildcards
        own = [(f, rule) for rule in self._names for f in getattr(self._rules, rule).rule.output]
        patterns = [(file, rule) for file, rule in own if "{" in str(file)]
        return {str(file): rule for file, rule in own if "{" not in str(file)}, patterns

    def write_expected(self, more: list[str], checks: bool = False) -> str:
        """Write which result each file of the workflow should show; return the written path.

        These are the files of all rules without wildcards, `more` files, and all their sources,
        direct or not. A target is left out if the configuration lacks its studies.
        """
        self.checked = checks
        found: dict[str, str] = {}
        for path in (*self._makers[0], *more):
            seen: set[str] = set()
            waiting = [path]
            with contextlib.suppress(Exception):
                while waiting:
                    recipe = self._recipe(waiting.pop())
                    if recipe is not None and recipe.name not in seen:
                        seen.add(recipe.name)
                        waiting += self._inputs[recipe.name]
                        for one in (recipe, *recipe.parts):
                            found |= one.expected()
        file = f"{self._place}/expected"
        write(Path(file), recipes.as_json(found))
        return file

    def _recipe(self, path: str) -> Recipe | None:
        """The recipe of a file; None if no rule makes it."""
        fixed, patterns = self._makers
        if path in fixed:
            return self._of_rule(fixed[path], {})
        for pattern, rule in patterns:
            found = pattern.match(path)
            if found:
                return self._of_rule(rule, found.groupdict())
        return None

    def _of_rule(self, rule: str, wildcards: Mapping[str, str]) -> Recipe:
        """The recipe of a rule, from its outputs, inputs and parameters."""
        mark = (rule, *wildcards.values())
        if mark in self._known:
            return self._known[mark]
        asked = getattr(self._rules, rule)
        names = SimpleNamespace(**wildcards)
        outputs = [file.apply_wildcards(wildcards) for file in asked.output]
        files = [str(file) for file in outputs]
        self._files |= zip(files, outputs, strict=True)
        inputs = _evaluated(asked.input, names)
        params = _evaluated(asked.params, names)
        sources = {role: paths for role, paths in inputs.items() if role != "after"}  # only awaited
        for role, paths in params.pop("reads", {}).items():
            sources[role] = self._placed(paths)
        parts = map(self._recipe, self._placed(params.pop("makes", [])))
        recipe = Recipe(
            name=self._name(files[0]),
            files=files,
            results=self.results,
            call=params.pop("call", ""),
            loads=list(params.pop("loads", [])),
            sources={role: self._source(paths) for role, paths in sources.items()},
            parts=[*filter(None, parts)],
            values=params,
        )
        self._inputs[recipe.name] = [path for own in inputs.values() for path in listed(own)]
        return self._known.setdefault(mark, recipe)

    def _placed(self, paths: Paths) -> Paths:
        """Paths with the prefix of a module; Snakemake adds it to inputs, not to parameters."""
        if not isinstance(paths, str):
            return [self._placed(path) for path in paths]
        if os.path.isabs(paths) or paths.startswith(".."):
            return paths
        return self.prefix + paths

    def _source(self, paths: Paths) -> Paths:
        """Paths of sources: results in the store, other files as they are."""
        if not isinstance(paths, str):
            return [self._source(path) for path in paths]
        found = self._recipe(str(paths))
        return str(paths) if found is None else found.stored(str(paths))

    def _name(self, file: str) -> str:
        """The name of a result: the path of its first file without the suffix."""
        return file.removeprefix(f"{self.results}/").rpartition(".")[0]

    def _file_of(self, rule: str, wildcards: Mapping[str, str]) -> str:
        """The file with the recipe of a job; the process that plans writes it.

        A job on another machine takes the one that was planned, even if the configuration has
        changed since then.
        """
        if not self._workflow.is_main_process:
            name = self._name(str(getattr(self._rules, rule).output[0].apply_wildcards(wildcards)))
            lines = self._plan.read_text("utf-8").splitlines()
            planned = dict(line.rsplit(" ", 1) for line in lines)
            return f"{self._place}/{name}.{planned[name]}.json"
        recipe = self._of_rule(rule, wildcards)
        file = f"{self._place}/{recipe.name}.{recipe.key}.json"
        self._write(rule, recipe, file)
        return file

    def _write(self, rule: str, recipe: Recipe, file: str) -> None:
        """Write a recipe so that Snakemake sees whether the result is there."""
        if self._changes:
            self._update_views(recipe)
        shown = recipe.is_shown(self.store)
        if not self._changes and not (shown and recipe.is_linked):
            # a run would start no job; an entry elsewhere is not checked
            self._kept[rule] += not self.runs and all(
                one.is_in(self.store)
                or any(os.path.isfile(other.entry(one.key) / NOTE) for other in self._others)
                for one in recipe.needed
            )
            for path in recipe.files:
                if os.path.islink(path) and not os.path.exists(path):  # Snakemake stops at it
                    Path(path).unlink(missing_ok=True)
                    self._refresh(path)
        newest = max(map(recipes.time_of, recipe.files))
        written = recipes.time_of(file)
        # what is missing is made anyway: a dry run need not write its recipe again
        kept = written > newest and (self._beside_a_run or (newest < 0.0 and not self.runs))
        if not (written == 0.0 if shown else kept):
            # later than the outputs, even if a clock was wrong
            recipe.write_as_of(file, 0.0 if shown else max(time.time(), newest + 0.01))
        self._refresh(file)
        if self.runs:  # note it for its job
            with self._plan.open("a", encoding="utf-8") as plan:
                print(recipe.name, recipe.key, file=plan)
            if not self._changes:
                self._waiting.append(recipe)
        if self._changes:  # leave no recipe of another result of this name
            for key in self._written[recipe.name] - {recipe.key}:
                Path(f"{self._place}/{recipe.name}.{key}.json").unlink(missing_ok=True)

    def _update_views(self, recipe: Recipe) -> None:
        """Show the results that the stores have, and remove files that show other ones."""
        self._taken += len(recipe.obtained(self.store, self._others))
        for one in (recipe, *recipe.parts):
            if one.is_linked and one.is_shown(self.store):
                continue
            keys = {one.key, *self._written[one.name]}
            for path, name in zip(one.files, one.names, strict=True):
                withdraw(Path(path), [self.store.entry(key) / name for key in keys])
            if one.is_in(self.store):
                one.show()
                self._shown += one is recipe
                for path in one.files:
                    # Snakemake's note is about another result
                    self._workflow.persistence.cleanup_metadata(self._files[path])
            for path in one.files:
                self._refresh(path)

    def _refresh(self, path: str) -> None:
        """Correct Snakemake's memory of a file; after ``iocache.clear()`` all seem missing."""
        known = self._workflow.iocache
        known.exists_local[path] = os.path.exists(path)
        for facts in (known.mtime, known.size, known.checksum):
            if facts:
                facts.pop(path, None)


def _evaluated(given: Any, wildcards: SimpleNamespace) -> dict[str, Any]:
    """Parameters or inputs, which may be functions or patterns of wildcards, but for the recipe."""
    found = {name: value for name, value in given.items() if name != "recipe"}
    for name, value in found.items():
        if callable(value):
            found[name] = value(wildcards)
        elif hasattr(value, "apply_wildcards") and "{" in value:
            found[name] = str(value.apply_wildcards(vars(wildcards)))
    return found
