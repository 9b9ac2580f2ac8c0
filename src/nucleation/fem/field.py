"""Fields of a body as the separable solver holds them, and the body's motion at one instant."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np

from ..types import Array


@dataclasses.dataclass(frozen=True)
class Field:
    """A displacement-like field: mode amplitudes and the values of u_y on the right edge.

    `modes` has shape (n_y + 1, 2, n_x): level from the interface up, component (x, y), mode.
    `edge` has shape (n_y + 1,); ``edge[0]`` is always zero.
    """

    modes: Array
    edge: Array

    def plus(self, other: Field) -> Field:
        """The sum of two fields."""
        return Field(self.modes + other.modes, self.edge + other.edge)

    def times(self, factor: float) -> Field:
        """The field times a number."""
        return Field(factor * self.modes, factor * self.edge)

    def to_arrays(self, name: str) -> dict[str, Array]:
        """The field as plain arrays, their names beginning with `name`."""
        return {f"{name}_modes": self.modes, f"{name}_edge": self.edge}

    @classmethod
    def from_arrays(cls, name: str, arrays: Mapping[str, Array]) -> Field:
        """The inverse of :meth:`to_arrays`."""
        return cls(arrays[f"{name}_modes"], arrays[f"{name}_edge"])


Terms = Sequence[tuple[float, Field]]


@dataclasses.dataclass(frozen=True)
class Motion:
    """Where a body is at one instant, and how fast: (w_x, u_y) with u_x = U(t) + w_x."""

    displacement: Field  # m
    velocity: Field  # m/s
    momentum: float  # kg/s, along x, of the velocity w_t

    def to_arrays(self, name: str) -> dict[str, Array]:
        """The motion as plain arrays, their names beginning with `name`; exact."""
        return {
            **self.displacement.to_arrays(f"{name}_displacement"),
            **self.velocity.to_arrays(f"{name}_velocity"),
            f"{name}_momentum": np.asarray(self.momentum),
        }

    @classmethod
    def from_arrays(cls, name: str, arrays: Mapping[str, Array]) -> Motion:
        """The inverse of :meth:`to_arrays`."""
        return cls(
            Field.from_arrays(f"{name}_displacement", arrays),
            Field.from_arrays(f"{name}_velocity", arrays),
            float(arrays[f"{name}_momentum"]),
        )


Motions = tuple[Motion, ...]
"""Of a body at some instants, the newest first."""
