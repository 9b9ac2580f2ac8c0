"""What the workflow plans: the recipe of each result, and whether the result is there already.

Every file that people open is the output of a rule. One more input of each rule is its recipe
(:mod:`.recipes`), a file below the store. :class:`Plan` writes it while Snakemake plans: as old as
a file can be where the rule's outputs are the result of that recipe, else with new content.
So Snakemake's own triggers do what is right, whatever happened to its notes or to times of files.

A run, unlike a dry run, begins with what the stores have: it is shown, and needs no job. Files that
show another result than they should are taken away, so that none is left if a job fails.
"""

import atexit
import contextlib
import hashlib
import os
import re
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from .job import FORCED
from .recipes import Recipe, listed, read
from .store import NOTE, PATTERN, Store, StoreError, key_in, others, plain
from .views import can_link, is_linked, is_shown, leads_nowhere, show, withdraw, write

RECIPES = "recipes"  # directory in a store, with one for each directory of results
WORKING = "directory"  # file beside recipes: where they were planned, as seen from the store
LOCKS = ".snakemake/locks"  # of a run that is at work, or was killed
HEAD = re.compile(rf'{{"key": "({PATTERN})"'.encode())  # of a recipe's file


class Plan:
    """The recipes of a workflow.

    Parameters
    ----------
    rules : Snakemake's; each is asked for once it is used, so it may be defined further down.
    workflow : Snakemake's, too.
    results : the directory of results, as the configuration names it.
    """

    def __init__(self, rules: Any, workflow: Any, results: str) -> None:
        self._rules = rules
        self._workflow = workflow
        self._configured = results
        self._names: list[str] = []  # of the rules that make results
        self._known: dict[tuple[str, ...], Recipe] = {}
        self._inputs: dict[str, list[str]] = {}  # by the name of the result
        self._files: dict[str, Any] = {}  # as Snakemake has them, by their paths
        self._kept: Counter[str] = Counter()  # jobs that a dry run lists, a run shows the result
        self._shown = 0  # results that were shown without a job
        self._taken = 0  # and those of them that came from other stores
        atexit.register(self._report)

    def __call__(self, rule: str) -> Callable[[Any], str]:
        """The input function that gives the file with the recipe of a rule."""
        self._names.append(rule)
        return lambda wildcards: self._file_of(rule, dict(wildcards.items())).removeprefix(
            self.prefix
        )

    def _report(self) -> None:
        """Say what was found in stores, in a line."""
        kept = ", ".join(f"{rule} {count}" for rule, count in self._kept.items() if count)
        if kept:
            print(f"Of these jobs a run needs none for what is in a store: {kept}", file=sys.stderr)
        if self._shown:
            taken = f", {self._taken} of them taken from other stores" if self._taken else ""
            print(f"Shown without a job: {self._shown} results{taken}", file=sys.stderr)

    @cached_property
    def results(self) -> str:
        """The directory of results where Snakemake has it: a module may have a prefix."""
        return self.prefix + self._configured

    @cached_property
    def prefix(self) -> str:
        """What a module's ``prefix:`` puts before the paths of its rules; empty without one."""
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
    def place(self) -> str:
        """The directory of the recipes in the store, which others may use at the same time."""
        places = [self._from_store(place) for place in (self.results, ".")]
        mark = hashlib.sha256("\n".join(places).encode()).hexdigest()[:8]
        return f"{self.store.directory}/{RECIPES}/{mark}"

    def _from_store(self, place: str) -> str:
        real = os.path.realpath
        return os.path.relpath(real(place), real(self.store.directory))

    @cached_property
    def runs(self) -> bool:
        """Whether jobs will run, not only be listed; they are told what is forced.

        Where another run is at work Snakemake stops later, and nothing may be changed before.
        """
        workflow = self._workflow
        runs = workflow.executor_plugin is not None and not (workflow.dryrun or workflow.touch)
        runs = runs and not any(Path(LOCKS).glob("*"))
        if runs:
            os.environ[FORCED] = "\n".join(_forced(workflow.dag_settings))
        return runs

    @cached_property
    def _others(self) -> list[Store]:
        return others(strict=False)

    @cached_property
    def _links(self) -> bool:
        """Whether there can be links: where not, copies are left, of whatever time they are."""
        return can_link(self.store.directory)

    @cached_property
    def _makers(self) -> tuple[dict[str, str], list[tuple[Any, str]]]:
        """Rules by their files, and those with wildcards by the patterns of these."""
        fixed, patterns = {}, []
        for rule in self._names:
            # of the rule itself: its proxy has no constraints of wildcards
            for file in getattr(self._rules, rule).rule.output:
                if "{" in str(file):
                    patterns.append((file, rule))
                else:
                    fixed[str(file)] = rule
        return fixed, patterns

    def recipe(self, path: str) -> Recipe | None:
        """The recipe of a file; None of a file that no rule makes."""
        fixed, patterns = self._makers
        if path in fixed:
            return self._of_rule(fixed[path], {})
        for pattern, rule in patterns:
            found = pattern.match(path)
            if found:
                return self._of_rule(rule, found.groupdict())
        return None

    def write_expected(self, more: list[str]) -> str:
        """Write what every file that the workflow makes should show; the path of what is written.

        These are the files of rules without wildcards, some more, and all that they are made from.
        What the configuration lacks the studies for is left out.
        """
        found: dict[str, str] = {}
        for path in (*self._makers[0], *more):
            with contextlib.suppress(Exception):
                found |= expected_of(self.behind([path]))
        file = f"{self.place}/expected"
        write(Path(file), plain(found))
        return file

    def behind(self, paths: list[str]) -> Iterator[Recipe]:
        """The recipes of some files, and of all that these are made from."""
        seen: set[str] = set()
        waiting = list(paths)
        while waiting:
            found = self.recipe(waiting.pop())
            if found is not None and found.name not in seen:
                seen.add(found.name)
                waiting += self._inputs[found.name]
                yield found
                yield from found.parts

    def _of_rule(self, rule: str, wildcards: Mapping[str, str]) -> Recipe:
        """The recipe of a rule with some wildcards."""
        mark = (rule, *wildcards.values())
        if mark not in self._known:
            self._known[mark] = self._put_together(rule, wildcards)
        return self._known[mark]

    def _put_together(self, rule: str, wildcards: Mapping[str, str]) -> Recipe:
        asked, names = getattr(self._rules, rule), SimpleNamespace(**wildcards)
        made = [file.apply_wildcards(wildcards) for file in asked.output]
        files = [*map(str, made)]
        self._files |= dict(zip(files, made, strict=True))
        inputs = {
            role: _given(value, names) for role, value in asked.input.items() if role != "recipe"
        }
        params = {name: _given(value, names) for name, value in asked.params.items()}
        before = inputs.pop("after", [])  # batches, of which `reads` says what is read
        read = {role: self._placed(paths) for role, paths in params.pop("reads", {}).items()}
        sources = inputs | read
        found = Recipe(
            name=self._name(files[0]),
            files=files,
            results=self.results,
            call=params.pop("call", ""),
            loads=list(params.pop("loads", [])),
            sources={role: self._source(paths) for role, paths in sources.items()},
            parts=[*filter(None, map(self.recipe, self._placed(params.pop("makes", []))))],
            values=params,
        )
        self._inputs[found.name] = [
            path for paths in (*inputs.values(), before) for path in listed(paths)
        ]
        return found

    def _placed(self, paths: Any) -> Any:
        """Files of a parameter with the prefix of a module, which Snakemake puts before inputs."""
        if not isinstance(paths, str):
            return [self._placed(path) for path in paths]
        return paths if os.path.isabs(paths) or paths.startswith("..") else self.prefix + paths

    def _name(self, file: str) -> str:
        """The name of a result: that of its first file, without the suffix."""
        return file.removeprefix(f"{self.results}/").rpartition(".")[0]

    def _source(self, paths: Any) -> Any:
        """What is read; of results the file in the store."""
        if not isinstance(paths, str):
            return [self._source(path) for path in paths]
        found = self.recipe(str(paths))
        return str(paths) if found is None else found.stored(str(paths))

    def _file_of(self, rule: str, wildcards: Mapping[str, str]) -> str:
        """The file with the recipe of a job, written if this process plans."""
        first = getattr(self._rules, rule).output[0].apply_wildcards(wildcards)
        file = f"{self.place}/{self._name(str(first))}.json"
        if self._workflow.is_main_process:  # and not a job, which takes its recipe as it is
            try:
                if not os.path.exists(f"{self.place}/{WORKING}"):
                    write(Path(self.place, WORKING), self._from_store("."))
                self._write(rule, self._of_rule(rule, wildcards), Path(file))
            except Exception as error:  # Snakemake would take an old file in the result's place
                raise SystemExit(f"{rule} can't be planned: {error}") from None
        return file

    def _write(self, rule: str, recipe: Recipe, file: Path) -> None:
        """Write a recipe so that Snakemake sees whether the result is there."""
        if self.runs:
            self._update_views(recipe, file)
        shown = is_shown(recipe, self.store)
        if not self.runs and not (shown and is_linked(recipe)):
            self._kept[rule] += all(self._is_kept(one.key) for one in recipe.needed)
            for path in map(Path, recipe.files):
                if leads_nowhere(path):  # Snakemake would stop there
                    path.unlink(missing_ok=True)
                    self._tell_of(str(path))
        if not (shown and is_old(file) and key_of(file) == recipe.key):
            write(file, recipe.text("" if shown else str(time.time_ns())))
        if shown:
            os.utime(file, (0, 0))
        self._tell_of(str(file))

    def _update_views(self, recipe: Recipe, file: Path) -> None:
        """Show what the stores have of a result, and take away what shows another one."""
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
                    # what Snakemake noted is of another result
                    self._workflow.persistence.cleanup_metadata(self._files[path])
            for path in one.files:
                self._tell_of(path)

    def _tell_of(self, path: str) -> None:
        """Correct what Snakemake remembers of a file: it may have looked before this changed it.

        Its own ``iocache.clear()`` keeps which directories it has listed, and takes every file in
        them for missing from then on.
        """
        known = self._workflow.iocache
        known.exists_local[path] = os.path.exists(path)
        for facts in filter(None, (known.mtime, known.size, known.checksum)):
            facts.pop(path, None)

    def _is_kept(self, key: str) -> bool:
        """Whether a store has a result, as far as can be told without copying it."""
        if self.store.note(key) is not None:
            return True
        return any((other.entry(key) / NOTE).is_file() for other in self._others)


def _given(value: Any, wildcards: Any) -> Any:
    """The value of a parameter or an input, which may be a function or a pattern of wildcards."""
    if callable(value):
        return value(wildcards)
    if hasattr(value, "apply_wildcards") and "{" in value:
        return str(value.apply_wildcards(vars(wildcards)))
    return value


def is_old(file: Path) -> bool:
    """Whether a recipe's file says that its result is shown."""
    return file.is_file() and file.stat().st_mtime == 0.0


def key_of(file: Path) -> str | None:
    """The key in a recipe's file; None if there is no file, or another one."""
    try:
        with file.open("rb") as stream:
            found = HEAD.match(stream.read(64))
    except OSError:
        return None
    return found[1].decode() if found else None


def kept_recipes(store: Store) -> Iterator[Recipe]:
    """The recipes of all directories of results that share a store, as they were planned.

    Those of a working directory that is gone are left out.

    Raises
    ------
    StoreError
        If one can't be read: nothing can be said of what is used.
    """
    for place in sorted(store.directory.glob(f"{RECIPES}/*")):
        for file in sorted(place.glob("**/*.json")) if _is_in_use(place, store) else []:
            try:
                yield read(file)
            except (OSError, ValueError, KeyError, TypeError) as error:
                message = f"{file} can't be read ({error!r}): delete it, plan again"
                raise StoreError(message) from None


def _is_in_use(place: Path, store: Store) -> bool:
    """Whether the working directory of some recipes is still there."""
    try:
        return (store.directory.resolve() / (place / WORKING).read_text("utf-8")).is_dir()
    except OSError:
        return True


def referred(store: Store) -> set[str]:
    """Keys in a store that recipes of any directory of results refer to, or their files show."""
    found: set[str] = set()
    for recipe in kept_recipes(store):
        for one in (recipe, *recipe.parts):
            found.add(one.key)
            found.update(key for path in one.source_keys.values() for key in path)
            links = (os.path.realpath(file) for file in one.files if os.path.islink(file))
            found.update(filter(None, map(key_in, links)))
    return found


def expected_of(recipes: Iterable[Recipe]) -> dict[str, str]:
    """What the files of some recipes should show: files of the store, or the text of a list."""
    return {
        file: recipe.stored(file) if recipe.call else recipe.manifest()
        for recipe in recipes
        for file in recipe.files
    }


def _forced(asked: Any) -> Iterator[str]:
    """Rules and files that Snakemake was told to make whether they are there or not; * for all.

    `asked` are Snakemake's settings of the DAG.
    """
    if asked.forceall:
        yield "*"
    yield from map(str, asked.forcerun)
    if asked.forcetargets:
        yield from map(str, asked.targets)
