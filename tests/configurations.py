"""The default configuration with one thing changed, and what is said about it."""

import copy
import functools
import json
from collections.abc import Iterable
from pathlib import Path

import pytest

from nucleation.fault.files import read_yaml
from nucleation.model.quantities import ParameterError
from replication.configuration.load import Configuration, configure, load

CONFIG = Path(__file__).parents[1] / "config"
# without the sharing of nodes that YAML's aliases bring: a change is to be one change
PAPER = json.loads(json.dumps(read_yaml(CONFIG / "config.yaml")))
PAPER["studies"] |= json.loads(json.dumps(read_yaml(CONFIG / "beyond.yaml")))["studies"]
del PAPER["studies"]["map"]  # a thousand runs more to go through, which are like the others


@functools.cache
def papers() -> Configuration:
    """The default configuration as it is, of which nothing may be changed."""
    return load()


def changed(place: str, value: object) -> dict:
    """The paper's configuration with one value changed, ``a.b.0.c`` naming its place."""
    config = copy.deepcopy(PAPER)
    *parents, last = place.split(".")
    node = config
    for part in parents:
        node = node[int(part)] if isinstance(node, list) else node[part]
    if isinstance(node, list):
        node[int(last) : int(last) + 1] = [value]
    else:
        node[last] = value
    return config


def with_run(**entry: object) -> dict:
    """The paper's configuration with one more entry of runs (its number is 6)."""
    return changed("studies.paper.runs.6", entry)


def study(*runs: dict, **settings: object) -> dict:
    """A configuration of one study, ``s``, and defaults for all else."""
    return {"studies": {"s": {**settings, "runs": list(runs)}}}


def messages(config: object) -> str:
    """What a bad configuration is told."""
    with pytest.raises(ParameterError) as caught:
        configure(config)
    return str(caught.value)


def assert_one_problem(config: object, fragments: Iterable[str]) -> None:
    """A configuration has one problem, and what is told of it has all of these fragments."""
    text = messages(config)
    for fragment in fragments:
        assert fragment in text
    assert text.startswith("the configuration has one problem:\n")
