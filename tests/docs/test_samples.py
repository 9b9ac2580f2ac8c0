"""Every code sample of README, CONTRIBUTING and docs runs, or is tried as far as is cheap.

Python samples of a page run one after the other in one namespace, in a directory of their own; a
``text`` block after one is what it has to print. What is done with a command of a shell sample is
said in one place, :data:`RULES`; a command without a rule fails.
"""

import contextlib
import io
import os
import re
import shlex
import subprocess
import sys
import tomllib
from collections import defaultdict
from functools import cache

import pytest
from docs.samples import PAGES, ROOT, commands, printed, samples
from snakemake.cli import parse_args

from nucleation.verification.crosscheck import freefem

SHOWN_FILES = {"my.yaml"} | {sample.file for page in PAGES for sample in samples(page)}
NAMES = [str(page.relative_to(ROOT)) for page in PAGES]


def run(arguments, **options):
    done = subprocess.run(
        arguments, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True, timeout=600, **options,
    )  # fmt: skip
    assert done.returncode == 0, f"{shlex.join(map(str, arguments))}\n{done.stdout}"
    return done.stdout


def make(arguments, directory):
    """Make says what it would do; its call of Snakemake, if any, is checked as well."""
    for call in planned_by_make(tuple(arguments)):
        snakemake(call, directory)


@cache
def planned_by_make(arguments):
    """The arguments of each call of Snakemake that make would do."""
    planned = run(["make", "--dry-run", *arguments]).replace("\\\n", " ").splitlines()
    calls = [shlex.split(line) for line in planned if line.startswith(".venv/bin/snakemake")]
    return [call[1:] for call in calls]


def snakemake(arguments, directory):
    """Snakemake understands its options; the targets are planned by :func:`test_targets`."""
    with contextlib.chdir(ROOT):  # profiles are found from there
        parsed = parse_args(arguments)[1]
    for path in parsed.configfile or []:
        assert path.is_file() or path.name in SHOWN_FILES, f"{path} is nowhere"


def install_debian(arguments, directory):
    """The script, on a machine that has every package."""
    has_all = directory / "dpkg-query"
    has_all.write_text("#!/bin/sh\nprintf installed\n")
    has_all.chmod(0o755)
    run(
        [ROOT / "workflow" / "install-debian.sh", *arguments],
        env={**os.environ, "PATH": f"{directory}:{os.environ['PATH']}"},
    )


def simulation(arguments, directory):
    """The command line's simulation says what it would run."""
    assert arguments[0] == "simulate", arguments
    output, *options = arguments[1:]
    planned = run([sys.executable, "-m", "nucleation", "simulate", directory / output, *options,
                   "--dry-run"])  # fmt: skip
    assert "theory: critical length" in planned


def container(arguments, tmp_path):
    """Without an engine of containers: the recipe is there, and Snakemake knows what is asked."""
    if arguments[0] == "build":
        assert (ROOT / arguments[arguments.index("-f") + 1]).is_file()
        return
    asked = arguments[arguments.index("nucleation") + 1 :]
    assert parse_args(asked)[1].targets == ["figure_studies"]


def packages(arguments, directory):
    """What is installed are extras that there are; test_packaging.py installs them."""
    (what,) = (re.fullmatch(r"\.(?:\[(.*)\])?", word) for word in arguments if word[0] == ".")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert {*filter(None, (what[1] or "").split(","))} <= set(project["optional-dependencies"])


RULES = {
    "pip": packages,
    "pipx": packages,
    "uvx": packages,
    "docker": container,
    "nucleation": simulation,
    "make": make,
    ".venv/bin/snakemake": snakemake,
    "workflow/install-debian.sh": install_debian,
}


def shell_samples():
    """Each command once, with the first place where it stands."""
    places = {}
    for page, name in zip(PAGES, NAMES, strict=True):
        for line, command in commands(samples(page)):
            places.setdefault(command, (page, f"{name}:{line}"))
    return [pytest.param(page, text, id=place) for text, (page, place) in places.items()]


@pytest.mark.system
@pytest.mark.parametrize(("page", "command"), shell_samples())
def test_shell(page, command, tmp_path):
    program, *arguments = shlex.split(command)
    assert program in RULES, f"say in RULES how to try: {command}"
    RULES[program](arguments, tmp_path)


def targets_by_configuration():
    """The targets of all commands, by the configuration given on the page as my.yaml, or ""."""
    found = defaultdict(set)
    for page in PAGES:
        if page.name == "extending.md":
            continue  # carried out in a copy of the project: test_extending.py
        mine = "".join(sample.code for sample in samples(page) if sample.file == "my.yaml")
        for _, command in commands(samples(page)):
            program, *arguments = shlex.split(command)
            calls = {".venv/bin/snakemake": [arguments]}
            if program == "make":
                calls["make"] = planned_by_make(tuple(arguments))
            for call in calls.get(program, []):
                with contextlib.chdir(ROOT):
                    parsed = parse_args(call)[1]
                    own = any(path.name == "my.yaml" for path in parsed.configfile or [])
                    found[mine if own else ""] |= set(parsed.targets)
    return found


@pytest.mark.system
def test_targets(tmp_path):
    """One dry run for all targets that are named anywhere, and one per configuration shown."""
    for mine, targets in targets_by_configuration().items():
        if not freefem.installed() and "CI" not in os.environ:
            targets -= {"crosscheck"}
        config = tmp_path / "my.yaml"
        config.write_text(mine or (ROOT / "config" / "quick.yaml").read_text())
        run([sys.executable, "-m", "snakemake", *targets, "--dry-run", "--quiet", "rules",
             "--directory", tmp_path, "--configfile", config])  # fmt: skip


@pytest.mark.system
@pytest.mark.parametrize("page", [page for page in PAGES if any(printed(samples(page)))],
                         ids=lambda page: page.name)  # fmt: skip
def test_python(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    namespace = {"__name__": "sample"}
    for sample, expected in printed(samples(page)):
        out = io.StringIO()
        code = compile("\n" * (sample.line - 1) + sample.code, str(page), "exec")
        with contextlib.redirect_stdout(out):
            exec(code, namespace)
        if expected is not None:
            assert out.getvalue() == expected, f"{page.name}:{sample.line}"


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_every_sample_has_a_language(page):
    """A block without a known language is no code, but a drawing; it is marked as text."""
    known = {"python", "sh", "console", "yaml", "text", "diff", "snakemake"}
    known |= {"{toctree}", "{eval-rst}", "{include}"}
    assert {(sample.language.split() or [""])[0] for sample in samples(page)} <= known
