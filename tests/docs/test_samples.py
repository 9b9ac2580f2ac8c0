"""Every code sample of README, CONTRIBUTING and docs runs, or is tried as far as is cheap.

Python samples of a page run one after the other in one namespace, in a directory of their own; a
``text`` block after one is what it has to print. What is done with a command of a shell sample is
said in one place, :data:`RULES`; a command without a rule fails.
"""

import contextlib
import io
import re
import shlex
import subprocess
import sys
import tomllib
from collections import defaultdict

import pytest
import yaml
from docs.samples import PAGES, ROOT, commands, printed, samples
from snakemake.cli import parse_args

from replication.configuration.load import configure

SHOWN_FILES = {"my.yaml"} | {sample.file for page in PAGES for sample in samples(page)}
NAMES = [str(page.relative_to(ROOT)) for page in PAGES]


def run(arguments, **options):
    done = subprocess.run(
        arguments,
        cwd=ROOT,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=600,
        **options,
    )
    assert done.returncode == 0, f"{shlex.join(map(str, arguments))}\n{done.stdout}"
    return done.stdout


def module(arguments, directory):
    """A benchmark is a module that can be run."""
    option, name = arguments
    path = ROOT / name.replace(".", "/")
    script = path / "__main__.py" if path.is_dir() else path.with_suffix(".py")
    assert option == "-m" and "__main__" in script.read_text()


def command_line(arguments, directory):
    """A simulation prints its plan. The commands that take seconds are run."""
    program = [sys.executable, "-m", "nucleation"]
    if arguments[0] != "simulate":
        assert "L_s" in run([*program, *arguments])
        return
    output, *options = arguments[1:]
    planned = run([*program, "simulate", directory / output, *options, "--dry-run"])
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
    "nucleation": command_line,
    ".venv/bin/python": module,
}
PLANNED = ("make", ".venv/bin/snakemake")  # by test_targets


def shell_samples():
    """Each command once, with the first place where it stands."""
    places = {}
    for page, name in zip(PAGES, NAMES, strict=True):
        for line, command in commands(samples(page)):
            if command.split()[0] not in PLANNED:
                places.setdefault(command, (page, f"{name}:{line}"))
    return [pytest.param(page, text, id=place) for text, (page, place) in places.items()]


@pytest.mark.system
@pytest.mark.parametrize(("page", "command"), shell_samples())
def test_shell(page, command, tmp_path):
    program, *arguments = shlex.split(command)
    assert program in RULES, f"say in RULES how to try: {command}"
    RULES[program](arguments, tmp_path)


def planned(program, *arguments):
    """The arguments of each call of Snakemake that a command is or, of make, would do."""
    if program == ".venv/bin/snakemake":
        return [arguments]
    lines = run(["make", "--dry-run", *arguments]).replace("\\\n", " ").splitlines()
    return [shlex.split(line)[1:] for line in lines if line.startswith(".venv/bin/snakemake")]


def targets_by_configuration():
    """The targets of all commands, by the configuration given on the page as my.yaml, or ""."""
    found = defaultdict(set)
    for page in PAGES:
        mine = "".join(sample.code for sample in samples(page) if sample.file == "my.yaml")
        words = [shlex.split(command) for _, command in commands(samples(page))]
        for call in (call for each in words if each[0] in PLANNED for call in planned(*each)):
            with contextlib.chdir(ROOT):  # profiles are found from there
                parsed = parse_args(call)[1]
            given = parsed.configfile or []
            assert all((ROOT / path).is_file() or path.name in SHOWN_FILES for path in given), call
            own = any(path.name == "my.yaml" for path in given)
            if page.name != "extending.md":  # in a copy of the project: test_extending.py
                found[mine if own else ""] |= set(parsed.targets)
    return found


@pytest.mark.system
def test_targets(tmp_path):
    """One dry run for all targets that are named anywhere, and one per configuration shown."""
    for mine, targets in targets_by_configuration().items():
        config = tmp_path / "my.yaml"
        config.write_text(mine or (ROOT / "config" / "quick.yaml").read_text())
        run(
            [
                sys.executable,
                "-m",
                "snakemake",
                *targets,
                "--dry-run",
                "--quiet",
                "rules",
                "--directory",
                tmp_path,
                "--configfile",
                config,
            ]
        )


@pytest.mark.system
@pytest.mark.parametrize(
    "page", [page for page in PAGES if any(printed(samples(page)))], ids=lambda page: page.name
)
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


@pytest.mark.parametrize("name", ["studies", "loadings"])
def test_configurations_of_pages_are_accepted(name):
    """One had keys of an earlier state of the configuration."""
    blocks = samples(ROOT / "docs" / f"{name}.md")
    (shown,) = (block.code for block in blocks if block.language == "yaml")
    assert configure(yaml.safe_load(shown)).runs


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_every_sample_has_a_language(page):
    """A block without a known language is no code, but a drawing; it is marked as text."""
    known = {"python", "sh", "console", "yaml", "text", "diff", "snakemake"}
    known |= {"{toctree}", "{eval-rst}", "{include}", "{raw}"}
    assert {(sample.language.split() or [""])[0] for sample in samples(page)} <= known
