"""Files of parameters, in YAML or JSON: the names of the options, with values and units."""

import math
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from nucleation.lengths.draws import parse_range
from nucleation.model.parameters import names
from nucleation.model.quantities import ParameterError, check
from nucleation.model.synonyms import hint
from nucleation.model.units import bounds, parse
from nucleation.strict_yaml import read_yaml
from nucleation.theory.values import OF_THEORY, QUANTITIES

from .study_names import study_parameters

_SECOND_BODY = ("second_shear_modulus", "second_poisson_ratio", "second_height")
"""The parameters in ``second_body``, in their order."""


def read_parameters(
    path: Path,
    keys: Collection[str] = (),
) -> dict[str, Any]:
    """The values in a YAML or JSON file, flat or in groups.

    Parameters
    ----------
    path : Path
        The file.
    keys : collection of str
        The parameters that are meant, for suggestions; by default all.

    Returns
    -------
    dict
        In SI units, by names in studies or of :class:`~nucleation.fault.fault.Fault`; with the
        parameters of the second body as of :func:`with_second_body`.

    Raises
    ------
    ParameterError
        If the file holds no mapping, or a name or a value is wrong.
    """
    content = read_yaml(path)
    if not isinstance(content, dict):
        raise ParameterError(f"{path} must hold a mapping (lines of key: value)")
    given: dict[str, Any] = {}
    try:
        for full, field, value in _entries(content):
            name = _name(full, field, value, keys)
            if name in given:
                raise ParameterError(f"{name} is given twice")
            given[name] = _value(name, value)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None
    return with_second_body(given)


def _entries(content: Mapping[Any, Any]) -> list[tuple[str, str, Any]]:
    """Full name, last part of the name, and value of each entry of a file."""
    entries = []
    for key, value in content.items():
        if not isinstance(value, dict):
            entries.append((str(key), str(key), value))
            continue
        for field, own in value.items():
            entries.append((f"{key}.{field}", str(field), own))
    return entries


def name_in_studies(
    name: str,
    keys: Collection[str] = (),
) -> str:
    """The name in studies of a parameter, from any of its names.

    Parameters
    ----------
    name : str
        A name.
    keys : collection of str
        The parameters that are meant, for suggestions; by default all.

    Returns
    -------
    str

    Raises
    ------
    ParameterError
        If no parameter has the name.
    """
    return _name(name, name, "...", keys)


def _name(
    full: str,
    field: str,
    value: Any,
    keys: Collection[str],
) -> str:
    """The name in studies of a parameter, from its full name or the last part of it."""
    known = names()
    declared = study_parameters()
    name = full if full in known else field
    if name in declared or (name in OF_THEORY and (not keys or name in keys)):
        return name
    try:
        return known.short(known.full(name))
    except ParameterError:
        own = list(keys or declared)
        suggestion = hint(field, own) or hint(field, declared) or f"known: {', '.join(own)}"
        raise ParameterError(
            f"{field} = {value!r} is not allowed: unknown key; {suggestion}"
        ) from None


def means_half_space(key: str, value: object) -> bool:
    """Whether the value of a height, by its name in studies, is that of a half-space."""
    text = str(value).strip().lower().removesuffix("m").strip()
    return key in ("height", "second_height") and text in ("inf", ".inf", "infinity")


def _value(
    key: str,
    value: Any,
) -> Any:
    """One value of a file in SI units; the second body is a text, as in its option."""
    if key == "second_body":
        return str(value)
    if means_half_space(key, value):
        return math.inf
    entry = QUANTITIES[key] if key in OF_THEORY else study_parameters()[key]
    if not isinstance(value, str):
        check(key, value, entry)
        return value
    return parse_range(key, value, entry)


def with_second_body(
    given: dict[str, Any],
) -> dict[str, Any]:
    """The values with ``second_body`` replaced by the parameters of the second body.

    Parameters
    ----------
    given : dict
        Values by their names in studies.

    Returns
    -------
    dict
        In SI units.

    Raises
    ------
    ParameterError
        If the text of the second body is wrong.
    """
    if "second_body" not in given:
        return given
    text = given["second_body"]
    if text == "rigid":
        return given
    if text in ("same", "deformable"):
        return given | {"second_body": "deformable"}
    parts = text.split(",")
    if not 2 <= len(parts) <= 3:
        modulus, ratio, _ = (bounds(QUANTITIES[key]) for key in _SECOND_BODY)
        raise ParameterError(
            f"second_body = {text!r} is not allowed: it must be same, rigid, or a shear modulus "
            f"in {modulus}, Poisson's ratio in {ratio} and perhaps a height, with commas between"
        )
    own: dict[str, Any] = {"second_body": "deformable"}
    try:
        for key, part in zip(_SECOND_BODY, parts, strict=False):
            own[key] = parse(key, part, QUANTITIES[key])  # of the theory: a height may be infinite
    except ParameterError as error:
        raise ParameterError(
            f"second_body = {text!r} is not allowed: commas separate its values, which have a "
            f"decimal point; {error}"
        ) from None
    return given | own
