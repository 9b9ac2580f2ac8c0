"""Numbers in sentences on two bodies against the tables in results/reference."""

import functools

import numpy as np
import xarray as xr
from asked import lengths_in_use
from docs.prose import says, span, table

from replication.tables.ratios import pairs_over_realisations


@functools.cache
def pairs():
    """The pairs, one row for each fault, on the usual mesh."""
    frame = table("pairs")
    frame = frame[frame["n_x"] < 1600]
    runs = xr.Dataset({name: ("run", frame[name].to_numpy()) for name in frame if name != "ratio"})
    return pairs_over_realisations(runs).to_dataframe()


def test_half_spaces_as_eta():
    high = pairs().query("study == 'pairs_identical' and height == 0.5").iloc[0]
    eta = np.pi / (1.0 - high["poisson_ratio"])
    unstable, drop = eta * high["stability_ratio"], eta * high["length_ratio"]
    low, most = eta * high["length_ratio_low"], eta * high["length_ratio_high"]
    assert high["realisations"] == 6
    says(
        "results.md",
        f"unstable at {high['stability_ratio']:.2f} of Eq. (6) and the force drops at "
        rf"{high['length_ratio']:.2f} of it. As $\eta$ of Eq. (3) these are {unstable:.1f} and "
        f"{drop:.1f} ({low:.1f} to {most:.1f})",
    )
    keys = ("creeping_asperity", "loaded_patch", "rubin_ampuero_localised")
    a, zeta = 0.0068, 0.0156
    fault = {"shear_modulus": 3.1e9, "poisson_ratio": 1 / 3, "normal_stress": 1e6, "a": a}
    found = lengths_in_use(**fault, zeta=zeta, slip_distance=5e-7)
    literature = [float(found[key]) * zeta * 1e6 / (3.1e9 * 5e-7) for key in keys]
    np.testing.assert_allclose(literature, (1.74, 1.80, 2.88), atol=0.005)
    assert np.isnan(found["rubin_ampuero_crack"])
    low, high = min(literature), max(literature)
    says(
        "README.md",
        f"unstable at {unstable:.1f}, and the force drops at {drop:.1f}.",
        f"that hold for this fault are {low:.1f} to {high:.1f}",
    )


def test_identical_half_spaces_with_other_weakening():
    own = pairs().query("study in ['pairs_weak', 'pairs_contrast'] and f_beta == 0.0")
    ratio = own.set_index([own["zeta_over_a"].round(2), "height"])["length_ratio"]
    three, ten, low, high = (ratio[key] for key in ((3, 1), (10, 0.3), (1, 1), (1, 2)))
    says(
        "results.md",
        f"drops at {three:.2f} of Eq. (6) for 3, {ten:.2f} for 10, and {low:.2f} ($H = 1$ m) or "
        f"{high:.2f} (2 m) for 1",
    )


def test_thin_pairs_and_held_layers():
    thin = pairs().query("height == 0.02 and study in ['pairs_identical', 'pairs_far_sides']")
    held = pairs().query("far_side == 'clamped' and f_beta == 0.0").sort_values("height")
    stable = held["stability_ratio"]
    assert list(held["height"]) == [0.02, 0.05, 0.1, 0.2]
    assert (held[["stability_ratio", "length_ratio"]].diff().iloc[1:] > 0.0).all(axis=None)
    says(
        "results.md",
        f"$L_s/L_c$ is {span(thin['stability_ratio'])} and $L/L_c$ {span(thin['length_ratio'])} "
        f"(means), while $L_c$ varies from {span(thin['critical_length'])} m",
        f"from $H = 0.02$ to 0.2 m $L_s/L_c$ rises from {stable.iloc[0]:.2f} to "
        f"{stable.iloc[-1]:.2f} and $L/L_c$ from {held['length_ratio'].iloc[0]:.2f} to "
        f"{held['length_ratio'].iloc[-1]:.2f}.",
    )


def test_identical_blocks():
    """The range of their lengths over the theory's."""
    own = pairs().query("study == 'pairs_identical'").sort_values("height")
    lower, high = own["length_ratio"].iloc[:-1], own["length_ratio"].iloc[-1]
    assert own["height"].iloc[-2:].tolist() == [0.2, 0.5]
    says(
        "results.md",
        f"$L_s/L_c$ is {span(own['stability_ratio'])} for all heights. $L/L_c$ is {span(lower)} up "
        f"to $H = 0.2$ m, and {high:.2f} for 0.5 m.",
    )


def contrasts(weakening):
    """The pairs of Figure 2 with one zeta/a, by f beta."""
    own = pairs().query("study == 'pairs_contrast'")
    own = own[np.isclose(own["zeta_over_a"], weakening)]
    return own.assign(f_beta=own["f_beta"].round(2)).set_index("f_beta").sort_index()


def over_half_spaces(weakening):
    """Their lengths over L_c^M."""
    own = contrasts(weakening)
    return own.filter(like="_ratio").mul(own["half_space_ratio"], axis=0)


def test_lengths_of_both_senses_of_a_contrast():
    own = over_half_spaces(10)[["length_ratio", "stability_ratio"]]
    below, same, above = (own.loc[contrast].map("{:.2f}".format) for contrast in (0.38, 0.0, -0.38))
    says(
        "results.md",
        rf"For $\zeta/a = 10$, $L$ and $L_s$ are {same.iloc[0]} and {same.iloc[1]} between "
        f"identical bodies, grow to {below.iloc[0]} and {below.iloc[1]} with the stiffer body "
        rf"below ($f\beta = 0.38$), and fall to {above.iloc[0]} and {above.iloc[1]} with it above "
        r"($f\beta = -0.38$)",
    )
