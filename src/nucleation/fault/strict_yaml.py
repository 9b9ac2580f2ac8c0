"""A YAML reader for configurations that refuses ambiguous input.

Numbers that YAML reads otherwise than they look, repeated keys and exponentially nested aliases
are errors.
"""

import math
import os
import re
from typing import Any

import yaml

from ..datasets.files import refuse_pipe
from ..model.quantities import ParameterError

_LEADING_ZERO = re.compile(r"[-+]?0[0-9_]+")
"""Integers that YAML 1.1 reads as octal, ``0400`` as 256; with colons it reads 1:30 as 90."""

_MOST_ENTRIES = 1_000_000
"""Entries of a file with its aliases expanded; ten lines of aliases can expand to billions."""


def read_yaml(path: str | os.PathLike[str]) -> Any:
    """The contents of a YAML file.

    Raises
    ------
    ParameterError
        If the file can't be read, is not YAML, or has a repeated key or an ambiguous number; the
        message names file, line and key.
    """
    try:
        refuse_pipe(path)
        with open(path, encoding="utf-8") as file:
            return yaml.load(file, Loader=_StrictLoader)
    except ParameterError:
        raise
    except OSError as error:
        raise ParameterError(f"{path} can't be read: {error.strerror}") from error
    except (
        yaml.YAMLError,
        ValueError,  # no UTF-8, no such date, ...
        TypeError,
        AttributeError,  # a tag that does not fit its value
        RecursionError,
    ) as error:
        raise ParameterError(f"{path} is not valid YAML: {error}") from error


class _StrictLoader(yaml.SafeLoader):
    """YAML's safe loader, which refuses repeated keys, octal numbers and too many aliases.

    libyaml's loader is faster, but a file with a hundred thousand brackets crashes it.
    """

    def get_single_node(self) -> yaml.Node | None:
        """The file as nodes; aliases share nodes."""
        node = super().get_single_node()
        if node is not None and _expanded_size(node, {}) > _MOST_ENTRIES:
            raise ParameterError(
                f"{_place(node)}: with its aliases written out it has more than "
                f"{_MOST_ENTRIES} entries"
            )
        return node

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        lines: dict[str, int] = {}
        for key, _ in node.value:
            line = key.start_mark.line + 1
            if not isinstance(key, yaml.ScalarNode):
                raise ParameterError(f"{_place(key)}: a key must be a word, not a list")
            merge = key.tag == "tag:yaml.org,2002:merge"
            if key.value in lines and not merge:
                first = lines[key.value]
                raise ParameterError(
                    f"{key.start_mark.name}: the key {key.value} is given twice, "
                    f"in lines {first} and {line}"
                )
            lines[str(key.value)] = line
        return super().construct_mapping(node, deep)

    def construct_integer(self, node: yaml.ScalarNode) -> int:
        """An integer without leading zeros and colons."""
        value = self.construct_yaml_int(node)
        if ":" in node.value or _LEADING_ZERO.fullmatch(node.value):
            raise _ambiguous(node, value)
        return value

    def construct_real(self, node: yaml.ScalarNode) -> float:
        """A number without colons."""
        value = self.construct_yaml_float(node)
        if ":" in node.value:
            raise _ambiguous(node, value)
        return value


_StrictLoader.add_constructor("tag:yaml.org,2002:int", _StrictLoader.construct_integer)
_StrictLoader.add_constructor("tag:yaml.org,2002:float", _StrictLoader.construct_real)


def _ambiguous(node: yaml.ScalarNode, value: float) -> ParameterError:
    return ParameterError(
        f"{_place(node)}: YAML reads {node.value} as {value}: "
        "write numbers without leading zeros and colons"
    )


def _expanded_size(node: yaml.Node, known: dict[yaml.Node, float]) -> float:
    """The number of nodes with aliases expanded; infinite if the node contains itself."""
    if node in known:
        return known[node]
    known[node] = math.inf  # the value that a node inside itself finds
    size = 1.0
    if isinstance(node, yaml.SequenceNode):
        for item in node.value:
            size += _expanded_size(item, known)
    elif isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            size += _expanded_size(key, known)
            size += _expanded_size(value, known)
    known[node] = size
    return size


def _place(node: yaml.Node) -> str:
    return f"{node.start_mark.name}, line {node.start_mark.line + 1}"
