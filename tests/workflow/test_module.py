"""The workflow as a module of another: its host behaves as it does without it."""

import dataclasses
import time
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]

OWN = """
configfile: "mine.yaml"

rule all:
    default_target: True
    input: "own.txt", "copy.txt"

rule own:
    output: "own.txt"
    params: x=config["x"]
    shell: "echo {params.x} > {output}"

rule copy:
    input: "in.txt"
    output: "copy.txt"
    shell: "cp {input} {output}"
"""

MODULE = f"""
module nucleation:
    snakefile: "{ROOT / "Snakefile"}"
    config: config["fault"]

use rule * from nucleation as fault_*
"""

STUDY = {"defaults": {"n_x": 40, "n_y": 4, "end_time": 0.2}, "runs": [{"height": 0.05}]}


def hosted(workflow, snakefile):
    """A workflow of somebody's own, with a profile of its own: Snakemake waits for ours' 10 s."""
    place = workflow.directory
    (place / "Snakefile").write_text(snakefile)
    (place / "profiles/default").mkdir(parents=True)
    (place / "profiles/default/config.yaml").write_text("cores: 2\n")
    configure(place, 1)
    return dataclasses.replace(workflow, checkout=place, config=place / "mine.yaml")


@pytest.fixture
def host(workflow, tmp_path):
    """What a host makes, made once."""
    (tmp_path / "in.txt").write_text("a\n")
    made = hosted(workflow, MODULE.join(OWN.split("\n\n", 1)))
    made.printed()
    assert "Nothing to be done" in made("--dry-run").stdout
    return made


def configure(directory, x):
    values = {"x": x, "fault": {"studies": {"s": STUDY}}}
    (directory / "mine.yaml").write_text(yaml.safe_dump(values))


def jobs(host):
    """The rules that a dry run lists."""
    return {
        line.split()[0]
        for line in host("--dry-run", "--quiet", "rules").stdout.splitlines()
        if line.startswith(("own ", "copy ", "fault_"))
    }


def test_parameters_and_inputs_of_the_host_count(host):
    configure(host.directory, 2)
    assert jobs(host) == {"own"}
    time.sleep(1.1)  # as much as Snakemake's clock of files may lag
    (host.directory / "in.txt").write_text("b\n")
    assert jobs(host) == {"own", "copy"}
    assert host().returncode == 0
    assert (host.directory / "own.txt").read_text() == "2\n"
    assert (host.directory / "copy.txt").read_text() == "b\n"


@pytest.mark.parametrize("prefix", ["", "fault/"])
def test_a_file_of_the_module_is_an_input_of_the_host(workflow, tmp_path, prefix):
    file = f"{prefix.rstrip('/')}/results/lengths.csv".lstrip("/")
    module = MODULE.replace("\n\nuse", f'\n    prefix: "{prefix}"\n\nuse') if prefix else MODULE
    count = f"""
rule count:
    default_target: True
    input: "{file}"
    output: "count.txt"
    shell: "wc -l < {{input}} > {{output}}"
"""
    host = hosted(workflow, f'configfile: "mine.yaml"\n{module}{count}')
    host.printed()
    assert (tmp_path / "count.txt").read_text() == "2\n"  # with the head
    assert "Nothing to be done" in host().stdout
    shown = [path.relative_to(tmp_path) for path in tmp_path.rglob("lengths.csv")]
    assert [str(path) for path in shown] == [file]
    (tmp_path / file).unlink()
    assert "Shown without a job: 1 results" in host().stdout
    assert "All is current" in host("fault_check").stdout


def test_paths_that_are_replaced_are_refused(workflow):
    module = MODULE.replace("\n\nuse", '\n    replace_prefix: {"results/": "r/"}\n\nuse')
    every = '\nrule every:\n    default_target: True\n    input: "r/lengths.csv"\n'
    done = hosted(workflow, f'configfile: "mine.yaml"\n{module}{every}')("--dry-run")
    assert done.returncode != 0 and "use prefix, not replace_prefix" in done.stdout
