"""Datasets follow the CF conventions: each variable says what it is, in units of UDUNITS."""

import pytest
from cf_units import Unit
from declared import VARIABLES

from nucleation.model import units

NUMBERS = {name: entry for name, entry in VARIABLES.items() if entry.units}


@pytest.mark.parametrize("written", sorted({entry.units for entry in NUMBERS.values()}))
def test_units_are_those_of_udunits(written):
    """Read to the same quantity by the library of the conventions as by our own."""
    read = Unit(written)
    assert not read.is_unknown()
    own = units.registry().parse_units("" if written == "1" else written)
    factor, base = units.registry().get_base_units(own)
    assert read.convert(1.0, Unit(f"{base:~}".replace(" ", "") or "1")) == pytest.approx(factor)


def test_a_unit_of_our_own_would_be_refused():
    with pytest.raises(ValueError, match="Failed to parse unit"):
        Unit("D/V squared")
