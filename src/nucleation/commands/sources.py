"""The run of a command: from options, a file, a dataset of a simulation, or the paper."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..fault import Fault
from ..fault.flat import declarations_of_flat, keywords, read_parameters, second_body
from ..installed import require
from ..lengths.draws import Range
from ..model.quantities import ParameterError
from ..model.settings import KINDS
from .system_text import papers_line

if TYPE_CHECKING:
    from ..run.run import Run


def base_of(options: Mapping[str, Any]) -> Run | None:
    """The run of the dataset in the options, if one is given."""
    file = options.get("file")
    if file is None or file.suffix != ".nc":
        return None
    if options.get("paper"):
        raise ParameterError("--paper is not allowed with a dataset, which has all values")
    return run_of_dataset(file)


def run_of_dataset(path: Path) -> Run:
    """The run whose record a file has."""
    require("solver")
    # imported here, since the libraries take a second
    from ..datasets import netcdf
    from ..extraction.extraction import parameters_of

    return parameters_of(netcdf.read(path, requires=["slip_rate", "driving_force"]))


_OF_FAULT = {
    *("shear_modulus", "poisson_ratio", "normal_stress", "slip_distance", "velocity"),
    *("friction", "a", "b", "zeta", "zeta_over_a", "second_shear_modulus"),
}
"""Constants of which one at least makes a fault another one than the paper's."""


def given_run(options: Mapping[str, Any]) -> tuple[Run, frozenset[str], list[str]]:
    """The run that options define, the names of given parameters, a line with the paper's ones.

    Values are in SI units, None: not given. Without a dataset the sizes of the block and the times
    follow from the theory. Without any constant of a fault it is the paper's.
    """
    from ..run.names import parameters
    from ..run.run import PAPER_RUN, Run

    base, file = base_of(options), options["file"]
    known = parameters()
    own = {k: x for k, x in options.items() if x is not None and (k in known or k == "density")}
    given = own if base or file is None else read_parameters(file, further=known) | own
    names = frozenset(given)
    _refuse(given, base)
    if base is not None:
        return base.replaced(**_expanded(given)), frozenset(base.to_dict()), []
    of_fault = {name: x for name, x in given.items() if name in declarations_of_flat()}
    if "second_body" in given:
        of_fault["second_body"] = given["second_body"]
    others = {name: x for name, x in given.items() if name not in of_fault}
    if options["paper"] or not _OF_FAULT & names:
        run = PAPER_RUN.replaced(**_expanded(of_fault)).completed(**others)
        return run, names, papers_line(names)
    return Run(Fault(**keywords(of_fault)), **others), names, []


def _refuse(given: Mapping[str, Any], base: Run | None) -> None:
    """Refuse ranges, and a seed of nothing."""
    for name, value in given.items():
        if isinstance(value, Range):
            raise ParameterError(
                f"{name}: a range is not allowed here, a simulation has one value of each "
                "parameter; `nucleation length` and `specimen` take ranges"
            )
    usual = base.perturbation.kind if base else "none"
    if "seed" in given and given.get("perturbation", usual) == "none":
        raise ParameterError(
            f"seed = {given['seed']} is not allowed with perturbation = none, which has no "
            f"realisations: perturbation must be one of {', '.join(KINDS[1:])}"
        )


def _expanded(given: Mapping[str, Any]) -> dict[str, Any]:
    """The values with the text of the second body as parameters of a run."""
    found = dict(given)
    text = found.pop("second_body", None)
    if text is None:
        return found
    kind = "rigid" if text == "rigid" else "deformable"
    return {"second_body": kind} | ({} if text == "rigid" else second_body(text)) | found
