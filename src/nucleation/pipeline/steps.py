"""What follows from the rules: keys of results, where they are, and what stands behind a target.

A rule says which function makes its result (``call``), code that is loaded by name (``loads``), all
other parameters, and inputs. From these follows the key. What a store has under a key is a plain
file to Snakemake; what it lacks is a link ``.links/NAME.KEY.nc`` that a job has to make. So nothing
of Snakemake decides what is current, and a dry run lists what will be computed.
"""

import contextlib
from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

from . import code
from .store import Store, StoreError, key, key_in, of_file, path_in, read_note

LINKS = ".links"  # directory below the results with what jobs tell Snakemake they have made
ABOUT = ("call", "loads")  # of a rule, and no parameters of a result
Sources = dict[str, "str | list[str]"]  # inputs by their role: a path, or a list of them


class Made(NamedTuple):
    """A result that a rule makes."""

    path: str  # in the store; or the link, if it is still to be made
    key: str
    shown: str  # its name in the directory of results, without a suffix
    sources: Sources


class Task(NamedTuple):
    """All that a job has to know of one result."""

    link: str
    call: str
    loads: Sequence[str]
    values: dict[str, Any]
    sources: Sources

    @property
    def key(self) -> str:
        """Of the result, from what it is made of."""
        function = self.call.partition(":")[2]
        return key(self.code, {"": function, **self.values}, self.source_keys)

    @property
    def source_keys(self) -> dict[str, list[str]]:
        """Keys of what it is made from, by their role."""
        return {role: [*map(of_file, _listed(p))] for role, p in self.sources.items()}

    @property
    def code(self) -> str:
        """Digest of the code that makes it."""
        return code.digest(*self.roots)

    @property
    def roots(self) -> tuple[str, ...]:
        """The modules that this code begins with."""
        return (self.call.partition(":")[0], *code.ALWAYS, *self.loads)


def task_of(link: str, params: Mapping[str, Any], sources: Sources) -> Task:
    """The task that a rule's parameters and inputs describe."""
    values = {name: value for name, value in params.items() if name not in ABOUT}
    return Task(link, params["call"], tuple(params.get("loads", ())), values, sources)


def _listed(paths: str | list[str]) -> list[str]:
    return [paths] if isinstance(paths, str) else paths


class Steps:
    """The results of a workflow's rules.

    Parameters
    ----------
    rules : Snakemake's; one is asked for once it is used, so it may stand further down.
    results : directory of the results.
    tidies : whether to remove links that lead to nothing. A cluster's jobs, which plan as well,
        must not: what others have just made may not be seen on their node yet.
    """

    def __init__(self, rules: Any, results: str, tidies: bool = False) -> None:
        self._rules, self._results, self._tidies = rules, results, tidies
        self.store = Store(f"{results}/store")
        self._made: dict[str, Made] = {}
        self._together: dict[tuple[str, str], str] = {}
        self._links: dict[str, str] = {}  # by key: what has two names is made once
        self.names: dict[str, set[str]] = {}  # under which a result is shown, by key
        self.made = cache(self._find)

    def link(self, name: str, suffix: str = "nc") -> str:
        """Output of a rule whose result is shown under a name: a link that bears the key."""
        return f"{self._results}/{LINKS}/{name}.{{key}}.{suffix}"

    def __call__(self, rule: str, name: str = "") -> str:
        """The path of a rule's result: in the store, or that of the link which is to be made.

        `name` is the value of the rule's wildcard of that name, if it has one.
        """
        return self.made(rule, name).path

    def several(self, rule: str, names: Iterable[str]) -> list[str]:
        """The paths of some results of one rule."""
        return [self(rule, name) for name in names]

    def together(self, rule: str, names: Iterable[str], job: str) -> list[Task]:
        """Have results of a rule made by a job for all of them; what this job has to do."""
        tasks = []
        for name in names:
            self._together[rule, name] = job
            tasks.append(self._task(rule, name)[0])
            self._links.setdefault(str(key_in(tasks[-1].link)), tasks[-1].link)
        return tasks

    def _task(self, rule: str, name: str) -> tuple[Task, str]:
        """What a result is made of, and the name it is shown under."""
        said = getattr(self._rules, rule)
        wildcards = SimpleNamespace(name=name)
        given = ((role, _given(value, wildcards)) for role, value in said.input.items())
        sources = {role: plain_paths(paths) for role, paths in given}
        params = {role: _given(value, wildcards) for role, value in said.params.items()}
        pattern = str(said.output[0])
        before, _, after = pattern.replace("{name}", name).partition(".{key}")
        shown = before.partition(f"/{LINKS}/")[2]
        task = task_of("", params, sources)
        if (rule, name) in self._together:
            before = f"{self._results}/{LINKS}/{self._together[rule, name]}/{name}"
        return task._replace(link=f"{before}.{task.key}{after}"), shown

    def _find(self, rule: str, name: str = "") -> Made:
        task, shown = self._task(rule, name)
        key, suffix = str(key_in(task.link)), task.link.rpartition(".")[2]
        done = self.store.note(key) is not None
        link = self._links.setdefault(key, task.link)
        if not done and self._tidies:
            self._unlink(Path(link), key)
        path = str(path_in(self.store.entry(key), f".{suffix}")) if done else link
        made = Made(path, key, shown, task.sources)
        self._made[path] = made
        self.names.setdefault(key, set()).add(shown)
        return made

    def _unlink(self, link: Path, key: str) -> None:
        """Remove a link that leads to no right entry: Snakemake would take it for made."""
        if link.is_symlink():
            try:
                read_note(self.store.entry(key))
            except StoreError:
                with contextlib.suppress(OSError):
                    link.unlink()

    def behind(self, paths: Iterable[str]) -> dict[str, Made]:
        """All results among some files, first, and what they are made of, all the way down."""
        found: dict[str, Made] = {}
        waiting = deque(paths)
        while waiting:
            path = waiting.popleft()
            if path in self._made and path not in found:
                found[path] = self._made[path]
                for sources in found[path].sources.values():
                    waiting += _listed(sources)
        return found


def _given(value: Any, wildcards: Any) -> Any:
    return value(wildcards) if callable(value) else value


def plain_paths(paths: Any) -> str | list[str]:
    """Paths as plain texts, without what Snakemake knows of them."""
    return str(paths) if isinstance(paths, str) else [str(path) for path in paths]
