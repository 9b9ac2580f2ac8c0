"""Contradictions among the settings of a configuration that no study changes."""

from collections.abc import Iterator

from nucleation.model.linearised import linearised, not_rounded_from
from nucleation.theory.critical import modes_on_rigid_base
from nucleation.theory.status import NoLength

from .configuration import Configuration
from .roles import OWN


def setting_problems(settings: Configuration) -> Iterator[str]:
    """Settings that are each allowed but contradict each other, a line for each problem."""
    yield from _threshold_problems(settings)
    own_studies_only = all(study.role == OWN for study in settings.studies.values())
    if own_studies_only:
        return  # no figure of the paper needs the other settings
    base = settings.base
    interface = settings.main_text_interface
    heights = settings.curves.heights
    try:
        for height in (min(heights), max(heights)):
            modes_on_rigid_base(height, base.material, interface)
    except NoLength as error:
        yield (
            f"main_text_interface: zeta = {interface.zeta:g} with a = {interface.a:g} is not "
            f"allowed: the theory's curve needs an instability at H = {height:g} m; {error}"
        )


def _threshold_problems(settings: Configuration) -> Iterator[str]:
    low = settings.extraction.edge_threshold_low
    edge = settings.extraction.edge_threshold
    high = settings.extraction.edge_threshold_high
    if not low <= edge <= high:
        yield (
            f"extraction: edge_threshold_low = {low:g}, edge_threshold = {edge:g}, "
            f"edge_threshold_high = {high:g} is not allowed: they must ascend, each in (0, 1]"
        )


def rounding_problems(settings: Configuration) -> Iterator[str]:
    """Values of the main text that are not roundings of the friction law's."""
    base = settings.base
    exact = linearised(base.friction, base.loading)
    foreign = not_rounded_from(settings.main_text_interface, exact)
    if foreign:
        text = foreign.replace(" is no", " is not allowed: it is no")
        yield (
            f"{text}; leave the section main_text_interface out, and the theory follows from the "
            "friction law"
        )
