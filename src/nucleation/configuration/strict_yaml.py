"""YAML as configurations need it: what YAML would silently take otherwise than meant is refused."""

import math
import os
import re
from typing import Any

import yaml

from ..model.quantities import ParameterError

LEADING_ZERO = re.compile(r"[-+]?0[0-9_]+")
"""Integers that YAML 1.1 reads as octal, ``0400`` as 256; with colons it reads 1:30 as 90."""


LARGEST = 1_000_000
"""Entries of a file with its aliases written out; ten lines of aliases can stand for billions."""


def read_yaml(path: str | os.PathLike[str]) -> Any:
    """The contents of a YAML file in which no key stands twice.

    Raises
    ------
    ParameterError
        Naming file, line and key; also for a file that can't be read or is not YAML.
    """
    try:
        with open(path, encoding="utf-8") as file:
            return yaml.load(file, Loader=_StrictLoader)
    except ParameterError:
        raise
    except OSError as error:
        raise ParameterError(f"{path} can't be read: {error.strerror}") from error
    except (yaml.YAMLError, ValueError, TypeError, AttributeError, RecursionError) as error:
        # no UTF-8, no such date, a tag that does not fit its value, ...
        raise ParameterError(f"{path} is not valid YAML: {error}") from error


class _StrictLoader(yaml.SafeLoader):
    """YAML's safe loader, which refuses keys given twice, numbers of another base, and bombs.

    libyaml's loader is faster, but a file with a hundred thousand brackets crashes it.
    """

    def get_single_node(self) -> yaml.Node | None:
        """The file as nodes, of which aliases may share some, but not to stand for millions."""
        node = super().get_single_node()
        if node is not None and _weight(node, {}) > LARGEST:
            raise ParameterError(
                f"{_place(node)}: with its aliases written out it has more than {LARGEST} entries"
            )
        return node

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        lines: dict[str, int] = {}
        for key, _ in node.value:
            line = key.start_mark.line + 1
            if not isinstance(key, yaml.ScalarNode):
                raise ParameterError(f"{_place(key)}: a key must be a word, not a list")
            if key.value in lines and key.tag != "tag:yaml.org,2002:merge":
                raise ParameterError(
                    f"{key.start_mark.name}: the key {key.value} stands twice, "
                    f"in lines {lines[key.value]} and {line}"
                )
            lines[str(key.value)] = line
        return super().construct_mapping(node, deep)

    def construct_number(self, node: yaml.ScalarNode) -> int | float:
        """A number written as people read it."""
        whole = node.tag.endswith(":int")
        value = self.construct_yaml_int(node) if whole else self.construct_yaml_float(node)
        if ":" in node.value or (whole and LEADING_ZERO.fullmatch(node.value)):
            raise ParameterError(
                f"{_place(node)}: YAML takes {node.value} for {value}: "
                "write numbers without leading zeros and colons"
            )
        return value


for _kind in ("int", "float"):
    _StrictLoader.add_constructor(f"tag:yaml.org,2002:{_kind}", _StrictLoader.construct_number)


def _weight(node: yaml.Node, known: dict[yaml.Node, float]) -> float:
    """The number of nodes that one stands for, itself included; endless if it is within itself."""
    if node not in known:
        known[node] = math.inf  # as long as it is not known, it is found only within itself
        below = node.value if isinstance(node, yaml.CollectionNode) else ()
        parts = [part for entry in below for part in (entry if type(entry) is tuple else (entry,))]
        known[node] = 1 + sum(_weight(part, known) for part in parts)
    return known[node]


def _place(node: yaml.Node) -> str:
    return f"{node.start_mark.name}, line {node.start_mark.line + 1}"
