"""What Snakemake has to make: decided by keys and records, not by times and Snakemake's notes.

:class:`Planner` knows the key of every file that the rules can make, from the rules themselves.
:class:`Records` takes the place of Snakemake's own notes when it decides what is current. Both use
only what stands in the results, so that copies, moves, lost notes and killed workflows change
nothing.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import snakemake.api  # first: its parts import each other
import snakemake.io
import snakemake.workflow
from snakemake.exceptions import WorkflowError
from snakemake.iocontainers import Wildcards
from snakemake.persistence import NO_PARAMS_CHANGE, ParamsChange
from snakemake.persistence.file import FilePersistence
from snakemake.settings.enums import RerunTrigger
from snakemake.target_jobs import parse_target_jobs_cli_args

from . import code, keys
from .keys import Store

TARGET_JOBS = "--target-jobs"
"""Snakemake's option that names jobs, as ``RULE:WILDCARD=VALUE,...``."""

ABOUT_THE_JOB = ("key", "code", "modules", "made", "expected", "places")
"""Parameters of rules that are no parameters of a result."""


def names_asked_for(command: Sequence[str]) -> set[str] | None:
    """Names of the runs and batches that a Snakemake is to make; None if it may be anything.

    A job on a cluster is another Snakemake. It needs to know of no other run than its own, as long
    as all that it makes is known by name and key. Which jobs it has, its command alone can tell
    while the rules are read.
    """
    after = itertools.dropwhile(lambda word: word != TARGET_JOBS, command)
    given = list(itertools.takewhile(lambda word: not word.startswith("--"), [*after][1:]))
    named = [dict(job.wildcards_dict) for job in parse_target_jobs_cli_args(given)]
    if not named or any("key" not in wildcards for wildcards in named):
        return None
    return {wildcards["name"] for wildcards in named}


class Planner:
    """The keys of all files that the rules of a workflow make.

    Parameters
    ----------
    workflow : Snakemake's; rules that make a file are there before it is asked for.
    store : of the results.
    """

    def __init__(self, workflow: Any, store: Store) -> None:
        self._workflow, self.store = workflow, store
        self._parts: dict[str, dict[str, str]] = {}
        self._producers: dict[str, Any] = {}

    def made_by(
        self, script: str | Path, modules: Sequence[str] | Callable[[Any], Sequence[str]] = ()
    ) -> dict[str, Any]:
        """Parameters for a rule whose script makes results: its code, and what it is held against.

        Parameters
        ----------
        script : path of the script.
        modules : dotted names of code that the script loads by name, such as a friction law; or a
            function of the rule's wildcards that gives them.
        """
        if callable(modules):
            loaded = modules
            digest: Any = lambda wildcards: self.code(script, loaded(wildcards))  # noqa: E731
            named: Any = lambda wildcards: list(loaded(wildcards))  # noqa: E731
        else:
            digest, named = self.code(script, modules), list(modules)
        return {
            "code": digest,
            "modules": named,
            "made": lambda wildcards, output: self.parts(str(output[0])),
            "expected": lambda wildcards, output: self._expected(str(output[0])),
        }

    def code(self, script: str | Path, modules: Sequence[str] = ()) -> str:
        """Digest of a script with the code that it loads by name."""
        return code.digest(str(script), *code.ALWAYS, *modules)

    def key(self, path: str) -> str:
        """The key that a file has to have; of a file that no rule makes, its content."""
        named = keys.key_in(path)
        if named is not None:
            return named
        if self._producer(path) is None:
            return keys.content(path) if Path(path).is_file() else "missing"
        return keys.joined(self.parts(path))

    def parts(self, path: str) -> dict[str, str]:
        """Digests of code, parameters and sources that make a file."""
        if path not in self._parts:
            rule, wildcards = self._producer(path)
            values = {
                name: value(wildcards) if callable(value) else value
                for name, value in rule.params._allitems()
                if name not in ABOUT_THE_JOB
            }
            sources = {
                role: [self.key(p) for p in paths] for role, paths in self._sources(path).items()
            }
            digest = rule.params.code
            digest = digest(wildcards) if callable(digest) else digest
            self._parts[path] = keys.parts(digest, values, sources)
        return self._parts[path]

    def parts_or_none(self, path: str) -> dict[str, str] | None:
        """The same; None where no rule of the configuration makes the file."""
        try:
            return self.parts(path) if self._producer(path) else None
        except (WorkflowError, KeyError):
            return None

    def _sources(self, path: str) -> dict[str, list[str]]:
        """The files that a file is made from, by their role in the rule."""
        rule, wildcards = self._producer(path)
        given = rule.expand_input(wildcards)[0]
        return {
            str(role or ""): [str(p) for p in ([value] if isinstance(value, str) else value)]
            for role, value in _items(given)
        }

    def _expected(self, path: str) -> dict[str, str]:
        """The key of every file that a file is made from, by path."""
        return {p: self.key(p) for paths in self._sources(path).values() for p in paths}

    def _producer(self, path: str) -> Any:
        """The rule that makes a file, with its wildcards; None if no rule does."""
        if path not in self._producers:
            found = (
                (rule, Wildcards(fromdict=rule.get_wildcards(path)))
                for rule in self._workflow.rules
                if not rule.norun and hasattr(rule.params, "code") and rule.is_producer(path)
            )
            self._producers[path] = next(found, None)
        return self._producers[path]

    def problem(self, path: str) -> str | None:
        """Why a file is not what the rules would make now; None if it is, or no rule makes it."""
        if self._producer(path) is None:
            return None
        if keys.key_in(path) is not None:
            return None if Path(path).is_file() else "it is missing"
        return self.store.problem(path, self.parts(path))


def _items(given: Any) -> list[tuple[str | None, Any]]:
    """Names and values of a list of files, the unnamed ones together."""
    named = dict(given.items())
    covered = {str(p) for v in named.values() for p in ([v] if isinstance(v, str) else v)}
    rest = [p for p in given if str(p) not in covered]
    return [*named.items(), *([(None, rest)] if rest else [])]


class Records(FilePersistence):
    """Snakemake's notes, whose word on what is current is that of the planner."""

    planner: Planner

    def has_metadata(self, job: Any) -> bool:
        """Every file is judged, whatever Snakemake knows of it."""
        return True

    def has_outdated_metadata(self, job: Any) -> bool:
        """Snakemake's notes are not asked."""
        return False

    async def incomplete(self, job: Any) -> list[Any]:
        """None: files are written whole or not at all."""
        return []

    def params_changed(self, job: Any, file: Any = None) -> ParamsChange:
        """What of a job's files is not what it would make now."""
        for path in [file] if file is not None else job.output:
            problem = self.planner.problem(str(path))
            if problem:
                return _Change(only_new={f"{path}: {problem}"}, files={str(path)})
        return NO_PARAMS_CHANGE

    def code_changed(self, job: Any, file: Any = None) -> Any:
        """The code is part of the key."""
        return [] if file is None else False

    input_changed = software_stack_changed = code_changed


class _Change(ParamsChange):
    """A reason in words."""

    def __str__(self) -> str:
        return "; ".join(sorted(self.only_new))


async def _never_newer(file: Any, time: Any) -> bool:
    """Times of files say nothing about what they hold."""
    return False


def decide_by_keys(planner: Planner) -> None:
    """Have a workflow decide by keys and records what it makes."""
    snakemake.workflow.FilePersistence = type("Records", (Records,), {"planner": planner})
    snakemake.io._IOFile.is_newer = _never_newer
    triggers = property(lambda _: frozenset({RerunTrigger.PARAMS}))
    snakemake.workflow.Workflow.rerun_triggers = triggers
