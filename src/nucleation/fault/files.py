"""Files of parameters: YAML without ambiguous input, and samples such as a posterior's."""

import csv
import os
import re
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from ..datasets.files import refuse_pipe
from ..lengths.ranges import SAMPLED
from ..model.hints import hint
from ..model.quantities import ParameterError
from ..model.units import rescaled
from ..types import Array

_HEADER = re.compile(r"\s*(\w+)\s*(?:\((.*)\)|\[(.*)\])?\s*")
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

    def construct_mapping(
        self,
        node: yaml.MappingNode,
        deep: bool = False,
    ) -> dict[Any, Any]:
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


def read_samples(path: Path | str) -> dict[str, Array]:
    """Joint samples of parameters, one in each row.

    Parameters
    ----------
    path : Path or str
        UTF-8 text with a header of parameters and units, ``slip_distance (um),a,b``; the default
        are SI units. Columns are separated by commas, semicolons or tabs. Empty lines and lines
        that begin with ``#`` are skipped.

    Returns
    -------
    dict
        Samples in SI units by parameter, all of shape (number of rows,).

    Raises
    ------
    ParameterError
        If there is no row, a column is unknown or there twice, or a unit or a cell is wrong; the
        message has file, line and column.

    Examples
    --------
    >>> from tempfile import NamedTemporaryFile
    >>> with NamedTemporaryFile("w+", suffix=".csv") as file:
    ...     _ = file.write("slip_distance (um),a\\n5,0.010\\n6,0.011\\n")
    ...     _ = file.seek(0)
    ...     samples = read_samples(file.name)
    >>> samples["a"]
    array([0.01 , 0.011])
    """
    try:
        refuse_pipe(path)
        text = Path(path).read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise ParameterError(f"{path} can't be read as UTF-8 text: {error}") from None
    lines = {i: line for i, line in enumerate(text.splitlines(), 1) if line.strip()}
    lines = {i: line for i, line in lines.items() if not line.lstrip().startswith("#")}
    if len(lines) < 2:
        raise ParameterError(f"{path} is empty: no row of samples below a header of parameters")
    header = next(iter(lines.values()))
    separator = next((sign for sign in ";\t," if sign in header), ",")
    cells = [
        [cell.strip() for cell in row] for row in csv.reader(lines.values(), delimiter=separator)
    ]
    places = [f"{path}, line {number}" for number in lines]
    labels = cells[0]
    rows = [
        _numbers(
            place,
            labels,
            row,
        )
        for place, row in zip(
            places[1:],
            cells[1:],
            strict=True,
        )
    ]
    found: dict[str, Array] = {}
    for label, values in zip(
        labels,
        np.array(rows).T,
        strict=True,
    ):
        if label.lower() in ("", "index"):
            continue  # numbers of rows
        name, unit = _column(places[0], label)
        if name in found:
            raise ParameterError(f"{places[0]}: column {name} is there twice")
        try:
            found[name] = rescaled(
                name,
                values,
                unit,
                SAMPLED[name],
            )
        except ParameterError as error:
            raise ParameterError(f"{places[0]}: {error}") from None
    return found


def _column(place: str, label: str) -> tuple[str, str]:
    """A column's parameter and unit."""
    parts = _HEADER.fullmatch(label)
    if parts is None or parts[1] not in SAMPLED:
        own_name = re.split(r"[(\[]", label)[0].strip()
        suggestion = hint(own_name, SAMPLED) or f"known: {', '.join(SAMPLED)}"
        raise ParameterError(
            f"{place}: column {label!r} is unknown; {suggestion}; the first line that is no "
            "comment names the parameters, such as 'slip_distance (um),a,b'"
        )
    unit = (parts[2] or parts[3] or SAMPLED[parts[1]].unit).strip()
    return parts[1], "1" if unit == "-" else unit


def _numbers(
    place: str,
    labels: list[str],
    cells: list[str],
) -> list[float]:
    """The numbers in the cells of a row."""
    if len(cells) != len(labels):
        counts = f"{len(cells)} cells, but the header has {len(labels)}"
        raise ParameterError(f"{place}: {counts}")
    found = []
    for label, text in zip(labels, cells, strict=True):
        try:
            found.append(float(text))
        except ValueError:
            found.append(np.nan)
        if np.isnan(found[-1]):
            raise ParameterError(
                f"{place}, column {label!r}: {text!r} is no number; write a decimal point, no unit "
                "and no separators of thousands"
            )
    return found
