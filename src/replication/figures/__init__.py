"""Figures: functions from datasets to matplotlib figures, and the roles that each needs.

``nucleation.pictures.style`` has sizes, fonts and colours, and :mod:`.laws` marks runs by law.
"""

from collections.abc import Collection

PAPERS = ("figure_1", "figure_2", "figure_3", "figure_s1", "figure_s2")
"""Figures of the paper."""

ROLES: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(PAPERS, ()),
    "figure_3": ("paper",),
    "figure_s2": ("paper",),
    "figure_3_extended": ("paper",),
    "figure_drop": ("drop",),
    "figure_weakening": ("weakening",),
    "figure_map": ("map",),
    "figure_patch_stability": ("paper",),
    "figure_blind": ("blind",),
}
"""Roles of studies by figure; figures of a user's studies are not in it."""


def drawable(roles: Collection[str]) -> list[str]:
    """The figures that a configuration with studies of these roles can make."""
    return [name for name, needed in ROLES.items() if set(needed) <= set(roles)]
