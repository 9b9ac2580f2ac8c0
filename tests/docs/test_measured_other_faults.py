"""The numbers of docs/drop.md on twenty other faults are those of the table of the reference."""

import numpy as np
from docs.prose import page, table

TEXT = page("drop.md")
LAWS = {"product": "product", "dieterich_ruina": "logarithmic"}


def faults():
    """The table, with lengths over L_c, from weak to strong weakening."""
    found = table("other_faults").sort_values("zeta_over_a")
    lengths = [name for name in found if name.split("_")[-1] in ("length", "low", "high")]
    lengths += ["length_least", "length_largest"]
    over = found[lengths].div(found["critical_length"], axis=0).add_suffix("_ratio")
    return found.join(over)


def base(row):
    if row["below"] == "rigid":
        return "rigid"
    is_same = row["second_shear_modulus"] == row["shear_modulus"]
    return "identical" if is_same else "different"


def simulated(row):
    if np.isnan(row["length"]):
        return f"none up to {row['reached_length_ratio']:.2f}"
    return f"{row['length_least_ratio']:.2f} to {row['length_largest_ratio']:.2f}"


def lines():
    for _, row in faults().iterrows():
        low, length, high = (row[f"expected_{name}_ratio"] for name in ("low", "length", "high"))
        cells = [
            f"{row['zeta_over_a']:.2f}",
            f"{LAWS[row['friction_law']]}, {row['evolution']}",
            base(row),
            f"{row['height'] / row['critical_length']:.2f}",
            f"{length:.2f} ({low:.2f} to {high:.2f})",
            simulated(row),
            f"{row['inside']} of {row['realisations']}",
        ]
        yield "| " + " | ".join(cells) + " |"


def test_a_row_for_each_fault():
    rows = list(lines())
    assert len(rows) == 20
    assert [row for row in rows if row not in TEXT] == []
