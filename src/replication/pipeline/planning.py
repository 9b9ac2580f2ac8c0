"""Planning: the recipe of each result, and whether the result is there already.

Every file that people open is the output of a rule. Each rule has its recipe (:mod:`.recipes`) as
one more input, a file below the store. :class:`Plan` writes it while Snakemake plans: as old as a
file can be if the rule's outputs show the result of that recipe, otherwise with new content. So
Snakemake's own triggers decide correctly, even if its notes are lost or times of files are wrong.

A run, unlike a dry run, starts by showing all results that are in a store; they need no job. Files
that show an outdated result are removed first, so that none is left if a job fails.
"""

import atexit
import contextlib
import hashlib
import os
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from .entries import NOTE
from .job import FORCED
from .keys import as_json
from .messages import LOGGER
from .recipe_files import RECIPES, WORKING, expected_of, key_of, marks_shown
from .recipes import Recipe, listed
from .store import Store, others
from .views import can_link, is_broken, is_linked, is_shown, show, withdraw, write

_LOCKS = ".snakemake/locks"  # of a run that is at work, or was killed

Paths = Any
"""One path, or several in a nested list, as Snakemake's texts or plain ones."""


class Plan:
    """The recipes of a workflow.

    Parameters
    ----------
    rules : rules of Snakemake
        By name. Each is read when it is used, so its definition may come later.
    workflow : workflow of Snakemake
        The one that is planned.
    results : str
        The directory of results, as the configuration names it.
    """

    def __init__(self, rules: Any, workflow: Any, results: str) -> None:
        self._rules = rules
        self._workflow = workflow
        self._configured = results
        self._names: list[str] = []  # of the rules that make results
        self._known: dict[tuple[str, ...], Recipe] = {}
        self._inputs: dict[str, list[str]] = {}  # by the name of the result
        self._files: dict[str, Any] = {}  # Snakemake's files by their paths
        self._kept: Counter[str] = Counter()  # jobs of a dry run that a run would not start
        self._shown = 0  # results that were shown without a job
        self._taken = 0  # results that were copied from other stores
        atexit.register(self._report)

    def __call__(self, rule: str) -> Callable[[Any], str]:
        """The input function of a rule; it returns the path of the recipe's file."""
        self._names.append(rule)

        def recipe_file(wildcards: Any) -> str:
            file = self._file_of(rule, dict(wildcards.items()))
            return file.removeprefix(self.prefix)

        return recipe_file

    def _report(self) -> None:
        kept = ", ".join(f"{rule} {count}" for rule, count in self._kept.items() if count)
        if kept:
            LOGGER.info(f"Of these jobs a run starts none, as a store has their results: {kept}")
        if self._shown:
            taken = f", {self._taken} of them taken from other stores" if self._taken else ""
            LOGGER.info(f"Shown without a job: {self._shown} results{taken}")

    @cached_property
    def results(self) -> str:
        """The directory of results for Snakemake, with the prefix of a module."""
        return self.prefix + self._configured

    @cached_property
    def prefix(self) -> str:
        """The ``prefix:`` of a module, which Snakemake puts before all paths of its rules."""
        name = str(getattr(self._rules, self._names[0]).output[0])
        before, found, _ = name.partition(self._configured)
        if not found:
            raise ValueError(f"{name} is not in {self._configured}: use prefix, not replace_prefix")
        return before

    @cached_property
    def store(self) -> Store:
        """The store of the results."""
        return Store(f"{self.results}/store")

    @cached_property
    def _place(self) -> str:
        """The directory of the recipes in the store; directories of results may share a store."""
        places = [self._from_store(place) for place in (self.results, ".")]
        mark = hashlib.sha256("\n".join(places).encode()).hexdigest()[:8]
        return f"{self.store.directory}/{RECIPES}/{mark}"

    def _from_store(self, place: str) -> str:
        """A path relative to the store."""
        store = os.path.realpath(self.store.directory)
        return os.path.relpath(os.path.realpath(place), store)

    @cached_property
    def runs(self) -> bool:
        """Whether jobs will run and not only be listed; then they learn which results are forced.

        If another run is at work, Snakemake stops later, and nothing may be changed before.
        """
        workflow = self._workflow
        if workflow.executor_plugin is None or workflow.dryrun or workflow.touch:
            return False
        if any(Path(_LOCKS).glob("*")):
            return False
        os.environ[FORCED] = "\n".join(_forced(workflow.dag_settings))
        return True

    @cached_property
    def _others(self) -> list[Store]:
        return others(strict=False)

    @cached_property
    def _links(self) -> bool:
        """Whether links are possible; if not, copies are left as they are, whatever their time."""
        return can_link(self.store.directory)

    @cached_property
    def _makers(self) -> tuple[dict[str, str], list[tuple[Any, str]]]:
        """Rules by their files, and pairs of a pattern with wildcards and its rule."""
        fixed: dict[str, str] = {}
        patterns: list[tuple[Any, str]] = []
        for rule in self._names:
            # the proxy of a rule lacks the constraints of wildcards
            for file in getattr(self._rules, rule).rule.output:
                if "{" in str(file):
                    patterns.append((file, rule))
                else:
                    fixed[str(file)] = rule
        return fixed, patterns

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

    def write_expected(self, more: list[str]) -> str:
        """Write which result each file of the workflow should show; return the written path.

        This includes the files of all rules without wildcards, the files `more`, and all their
        sources. A target is left out if the configuration lacks its studies.
        """
        found: dict[str, str] = {}
        for path in (*self._makers[0], *more):
            with contextlib.suppress(Exception):
                found |= expected_of(self._with_sources(path))
        file = f"{self._place}/expected"
        write(Path(file), as_json(found))
        return file

    def _with_sources(self, path: str) -> Iterator[Recipe]:
        """The recipes of a file and of all its sources, direct or not."""
        seen: set[str] = set()
        waiting = [path]
        while waiting:
            found = self._recipe(waiting.pop())
            if found is not None and found.name not in seen:
                seen.add(found.name)
                waiting += self._inputs[found.name]
                yield found
                yield from found.parts

    def _of_rule(self, rule: str, wildcards: Mapping[str, str]) -> Recipe:
        mark = (rule, *wildcards.values())
        if mark not in self._known:
            self._known[mark] = self._made(rule, wildcards)
        return self._known[mark]

    def _made(self, rule: str, wildcards: Mapping[str, str]) -> Recipe:
        """Make the recipe of a rule from its outputs, inputs and parameters."""
        asked = getattr(self._rules, rule)
        names = SimpleNamespace(**wildcards)
        outputs = [file.apply_wildcards(wildcards) for file in asked.output]
        files = [str(file) for file in outputs]
        self._files |= dict(zip(files, outputs, strict=True))
        inputs = {}
        for role, value in asked.input.items():
            if role != "recipe":
                inputs[role] = _evaluated(value, names)
        params = {name: _evaluated(value, names) for name, value in asked.params.items()}
        waited_for = inputs.pop("after", [])  # batches; `reads` names the files that are read
        reads = params.pop("reads", {})
        sources = inputs | {role: self._placed(paths) for role, paths in reads.items()}
        parts = [self._recipe(path) for path in self._placed(params.pop("makes", []))]
        recipe = Recipe(
            name=self._name(files[0]),
            files=files,
            results=self.results,
            call=params.pop("call", ""),
            loads=list(params.pop("loads", [])),
            sources={role: self._source(paths) for role, paths in sources.items()},
            parts=[part for part in parts if part is not None],
            values=params,
        )
        needed = [listed(paths) for paths in (*inputs.values(), waited_for)]
        self._inputs[recipe.name] = [path for paths in needed for path in paths]
        return recipe

    def _placed(self, paths: Paths) -> Paths:
        """Paths with the prefix of a module; Snakemake adds it to inputs, not to parameters."""
        if not isinstance(paths, str):
            return [self._placed(path) for path in paths]
        if os.path.isabs(paths) or paths.startswith(".."):
            return paths
        return self.prefix + paths

    def _name(self, file: str) -> str:
        """The name of a result: the path of its first file without the suffix."""
        return file.removeprefix(f"{self.results}/").rpartition(".")[0]

    def _source(self, paths: Paths) -> Paths:
        """Paths of sources: results in the store, other files as they are."""
        if not isinstance(paths, str):
            return [self._source(path) for path in paths]
        found = self._recipe(str(paths))
        return str(paths) if found is None else found.stored(str(paths))

    def _file_of(self, rule: str, wildcards: Mapping[str, str]) -> str:
        """The file with the recipe of a job; this process writes it if it plans."""
        first = getattr(self._rules, rule).output[0].apply_wildcards(wildcards)
        file = f"{self._place}/{self._name(str(first))}.json"
        if self._workflow.is_main_process:  # a job takes its recipe as it is
            try:
                if not os.path.exists(f"{self._place}/{WORKING}"):
                    write(
                        Path(self._place, WORKING),
                        self._from_store("."),
                    )
                self._write(rule, self._of_rule(rule, wildcards), Path(file))
            except Exception as error:  # else Snakemake would use an outdated file of the result
                raise SystemExit(f"{rule} can't be planned: {error}") from None
        return file

    def _write(self, rule: str, recipe: Recipe, file: Path) -> None:
        """Write a recipe so that Snakemake sees whether the result is there."""
        if self.runs:
            self._update_views(recipe, file)
        shown = is_shown(recipe, self.store)
        if not self.runs and not (shown and is_linked(recipe)):
            self._kept[rule] += all(self._is_kept(one.key) for one in recipe.needed)
            self._remove_broken_links(recipe)
        if not (shown and marks_shown(file) and key_of(file) == recipe.key):
            write(file, recipe.text("" if shown else str(time.time_ns())))
        if shown:
            os.utime(file, (0, 0))
        self._refresh(str(file))

    def _remove_broken_links(self, recipe: Recipe) -> None:
        """Remove links to missing files, at which Snakemake would stop."""
        for path in recipe.files:
            if is_broken(Path(path)):
                Path(path).unlink(missing_ok=True)
                self._refresh(path)

    def _update_views(self, recipe: Recipe, file: Path) -> None:
        """Show the results that the stores have, and remove files that show outdated ones."""
        for one in recipe.needed:
            if self.store.note(one.key) is None and self.store.take(one.key, self._others):
                self._taken += 1
        for one in (recipe, *recipe.parts):
            if is_shown(one, self.store) and (is_linked(one) or not self._links):
                continue
            earlier = self.store.entry(key_of(file) or "none")
            for path in one.files:
                withdraw(Path(path), earlier / Path(recipe.stored(path)).name)
            if all(self.store.note(part.key) for part in one.needed):
                show(one)
                self._shown += one is recipe
                for path in one.files:
                    # Snakemake's note is about another result
                    self._workflow.persistence.cleanup_metadata(self._files[path])
            for path in one.files:
                self._refresh(path)

    def _refresh(self, path: str) -> None:
        """Correct Snakemake's memory of a file, which it may have read before the change.

        Its own ``iocache.clear()`` keeps the list of directories that it has read, and takes every
        file in them for missing from then on.
        """
        known = self._workflow.iocache
        known.exists_local[path] = os.path.exists(path)
        for facts in (known.mtime, known.size, known.checksum):
            if facts:
                facts.pop(path, None)

    def _is_kept(self, key: str) -> bool:
        """Whether a store has a result; an entry elsewhere is not checked."""
        if self.store.note(key) is not None:
            return True
        return any((other.entry(key) / NOTE).is_file() for other in self._others)


def _evaluated(value: Any, wildcards: SimpleNamespace) -> Any:
    """The value of a parameter or an input, which may be a function or a pattern of wildcards."""
    if callable(value):
        return value(wildcards)
    if hasattr(value, "apply_wildcards") and "{" in value:
        return str(value.apply_wildcards(vars(wildcards)))
    return value


def _forced(dag_settings: Any) -> Iterator[str]:
    """Rules and files that Snakemake makes even if they are there; * for all."""
    if dag_settings.forceall:
        yield "*"
    yield from map(str, dag_settings.forcerun)
    if dag_settings.forcetargets:
        yield from map(str, dag_settings.targets)
