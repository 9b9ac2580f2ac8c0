"""Files of parameters: YAML without ambiguous input."""

import os
import re
from typing import Any

import yaml

from ..datasets.files import refuse_pipe
from ..model.quantities import ParameterError

_OCTAL = re.compile(r"[-+]?0[0-9_]+")


def read_yaml(path: str | os.PathLike[str]) -> Any:
    """The contents of a YAML file.

    A ParameterError names a file that can't be read or is not YAML, a key that is there twice, and
    a number that YAML reads otherwise than it looks.
    """
    try:
        refuse_pipe(path)
        with open(path, encoding="utf-8") as file:
            return yaml.load(file, Loader=_Loader)
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


class _Loader(yaml.SafeLoader):
    """YAML's safe loader; libyaml's is faster, but a hundred thousand brackets crash it."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        lines: dict[str, int] = {}
        for key, _ in node.value:
            line = key.start_mark.line + 1
            if key.value in lines and key.value != "<<":
                raise ParameterError(
                    f"{key.start_mark.name}: the key {key.value} is given twice, "
                    f"in lines {lines[key.value]} and {line}"
                )
            lines[key.value] = line
        return super().construct_mapping(node, deep)


def _number(loader: _Loader, node: yaml.ScalarNode) -> Any:
    """A number that looks as YAML 1.1 reads it: 0400 would be 256, 1:30 90."""
    is_integer = node.tag.endswith(":int")
    value = (loader.construct_yaml_int if is_integer else loader.construct_yaml_float)(node)
    if ":" in node.value or (is_integer and _OCTAL.fullmatch(node.value)):
        raise ParameterError(
            f"{node.start_mark.name}, line {node.start_mark.line + 1}: YAML reads {node.value} as "
            f"{value}: write numbers without leading zeros and colons"
        )
    return value


_Loader.add_constructor("tag:yaml.org,2002:int", _number)
_Loader.add_constructor("tag:yaml.org,2002:float", _number)
