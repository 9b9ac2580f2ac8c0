"""Claims on the friction law: Sect. 5's values, Table S1, Text S2.1 and Fig. S1."""

from __future__ import annotations

import math

import numpy as np

from ...configuration.roles import JUDGED, PAPERS
from ..claim import Claim, Result, claim
from ..evidence import Evidence, on_both
from ..said import Missing, Ours, above, below, formula, number, words

CLAIMS: list[Claim] = []

FINE = np.geomspace(1e-11, 10.0, 4801)  # m/s


def _value(name: str, printed: str, where: str, quotation: str, coefficient: int) -> None:
    """Enter a value that the paper prints for a coefficient of the expansion at V."""
    symbol = ("f0", "a", "zeta")[coefficient]

    @claim(
        CLAIMS, id=name, where=where, statement=f"Table S1 gives {symbol} = {printed} at V.",
        quotation=quotation, said=number(printed),
        method="exact derivatives of the full law at V = 10 um/s, steady state",
    )  # fmt: skip
    def value(evidence: Evidence) -> Ours:
        return Ours.exactly(evidence.friction.expansion(evidence.loading.velocity)[coefficient])


_value("f0-table", "0.414", "Text S2.1 and Table S1", r"$f_0=0.414$", 0)
_value("a-table", "0.00682", "Text S2.1 and Table S1", r"$a=0.00682$", 1)
_value("zeta-table", "0.0156", "Text S2.1 and Table S1", r"$\zeta=0.0156$", 2)
_value("f0-main", "0.41", "Sect. 5", r"$f_0=0.41$", 0)
_value("a-main", "0.0068", "Sect. 5", r"$a=0.0068$", 1)
_value("zeta-main", "0.016", "Sect. 5", r"$\zeta=0.016$", 2)


@claim(
    CLAIMS, id="slip-rate-over-v0", where="Text S2.1",
    statement="V is four orders of magnitude larger than v0.",
    quotation=r"which is $4$ order of magnitude larger than $v_0$",
    method="decimal logarithm of V/v0, both of Table S1", said=number("4"), input=True,
)  # fmt: skip
def slip_rate_over_v0(evidence: Evidence) -> Ours:
    ratio = evidence.loading.velocity / evidence.friction.regularisation_slip_rate
    return Ours.exactly(math.log10(ratio))


@claim(
    CLAIMS, id="friction-vanishes", where="Text S2.1",
    statement="Friction vanishes for v -> 0.",
    quotation=r"ensures that $f$ vanishes in the limit $v\to0$",
    method="f at v = 1e-5 v0 and phi = 1 s over f0", said=words("negligible"),
)  # fmt: skip
def friction_vanishes(evidence: Evidence) -> Ours:
    law = evidence.friction
    f = law.coefficient(1e-5 * law.regularisation_slip_rate, 1.0)
    return Ours.exactly(f / law.expansion(evidence.loading.velocity).f0)


@claim(
    CLAIMS, id="logarithmic-law", where="Eq. (S-log)",
    statement="Near V the full law is the logarithmic one.",
    quotation=r"we expand the full friction law around $V=10^{-5}$ m/s",
    method="logarithmic over full law, v and phi from a tenth to ten times V and D/V; the worst",
    said=words("extremely well"),
)  # fmt: skip
def logarithmic_law(evidence: Evidence) -> Ours:
    law, velocity = evidence.friction, evidence.loading.velocity
    factors = np.geomspace(0.1, 10.0, 41)
    v, phi = np.meshgrid(velocity * factors, law.steady_state(velocity) * factors)
    ratio = law.logarithmic(v, phi, velocity) / law.coefficient(v, phi)
    return Ours.worst(ratio.ravel(), target=1.0)


def steady_extremes(evidence: Evidence) -> tuple[float, float]:
    """Slip rates (m/s) of the maximum and of the minimum of steady-state friction around V."""
    f = evidence.friction.steady_coefficient(FINE)
    turns = 1 + np.flatnonzero(np.diff(np.sign(np.diff(f))) != 0)
    lower = [i for i in turns if FINE[i] < evidence.loading.velocity and f[i] > f[i - 1]]
    upper = [i for i in turns if FINE[i] > evidence.loading.velocity and f[i] < f[i - 1]]
    if not lower or not upper:
        raise Missing("Steady-state friction has no velocity-weakening branch around V")
    return float(FINE[lower[-1]]), float(FINE[upper[0]])


@claim(
    CLAIMS, id="steady-agreement", where="Text S2.1 and Fig. S1",
    statement="Full and logarithmic steady-state friction agree extremely well over a huge range "
    "of slip rates within the velocity-weakening branch.",
    quotation=r"agrees extremely well with the full friction law over a huge range of slip "
    r"velocities within the velocity-weakening branch",
    method="decades of slip rate around V, within the branch, in which the two differ by less "
    "than 2 %", unit="decades", said=words("huge range"),
)  # fmt: skip
def steady_agreement(evidence: Evidence) -> Ours:
    law, velocity = evidence.friction, evidence.loading.velocity
    low, high = steady_extremes(evidence)
    v = FINE[slice(*np.searchsorted(FINE, [low, high]))]
    state = law.characteristic_slip_distance / v
    difference = np.abs(law.logarithmic(v, state, velocity) / law.steady_coefficient(v) - 1.0)
    middle = int(np.abs(np.log(v / velocity)).argmin())
    off = np.flatnonzero(difference >= 0.02)
    first = off[off < middle].max(initial=-1) + 1
    last = off[off > middle].min(initial=v.size) - 1
    return Ours.exactly(math.log10(v[last] / v[first]))


@claim(
    CLAIMS, id="strengthening-branch", where="Text S2.1 and Fig. S1",
    statement="Steady-state friction has a minimum, beyond which it strengthens, far above V.",
    quotation=r"exhibits a transition to velocity-strengthening friction",
    method="slip rate of the minimum over V", said=words("much"),
)  # fmt: skip
def strengthening_branch(evidence: Evidence) -> Ours:
    return Ours.exactly(steady_extremes(evidence)[1] / evidence.loading.velocity)


@claim(
    CLAIMS, id="weakening-branch", where="Text S2.1 and Fig. S1",
    statement="V lies well within the velocity-weakening branch.",
    quotation=r"well within the velocity-weakening branch of the friction law",
    method="V over the slip rate of the maximum of steady-state friction", said=words("much"),
)  # fmt: skip
def weakening_branch(evidence: Evidence) -> Ours:
    return Ours.exactly(evidence.loading.velocity / steady_extremes(evidence)[0])


@claim(
    CLAIMS, id="minimum-plays-no-role", where="Text S2.1",
    statement="The strengthening branch plays no role in the nucleation.",
    quotation=r"but it plays no role in the nucleation process",
    method="largest slip rate at the onset over that of the minimum; the worst run of the series",
    said=below(1.0),
)  # fmt: skip
def minimum_plays_no_role(evidence: Evidence) -> Result:
    minimum = steady_extremes(evidence)[1]

    def ours(study: str) -> Ours:
        runs = evidence.each_measured(study)
        return Ours.worst([run.onset_rate / minimum for run in runs])

    return on_both(evidence, ours)


@claim(
    CLAIMS, id="regularisation-irrelevant", where="Text S2.1",
    statement="For most of the creep patch the regularisation v0 is irrelevant, v >> v0.",
    quotation=r"for most of the creep patch --- where the typical slip velocity is $V\gg v_0$",
    method="part of the patch at the onset that slips at more than ten times v0; the worst run",
    said=words("most"),
)  # fmt: skip
def regularisation_irrelevant(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        runs = evidence.each_measured(study)
        return Ours.worst([run.regular_share for run in runs], target=1.0)

    return on_both(evidence, ours)


@claim(
    CLAIMS, id="state-rate-at-v", where="Eq. (S-phi_approx)",
    statement="At V the regularised speed sqrt(v^2 + v0^2) is v.",
    quotation=r"\dot{\phi}\simeq 1-\frac{\phi v}{D}",
    method="sqrt(V^2 + v0^2)/V", said=formula(1.0, "1"),
)  # fmt: skip
def state_rate_at_v(evidence: Evidence) -> Ours:
    velocity = evidence.loading.velocity
    return Ours.exactly(evidence.friction.slip_speed(velocity) / velocity)


def _well_approximated(evidence: Evidence, part: str, note: str = "") -> Result:
    """Where the slip law with v is good: the least of all its runs, of either study."""

    def share(study: str) -> Ours:
        runs = evidence.each_measured(study, law="slip")
        return Ours.worst([getattr(run, part) for run in runs], target=1.0)

    return Result(share(JUDGED), on_papers_mesh=share(PAPERS), note=note)


@claim(
    CLAIMS, id="slip-law-approximation", where="Text S2.1, below Eq. (S-phi_slip)",
    statement="The slip law with v in the place of sqrt(v^2 + v0^2) is a very good approximation "
    "almost everywhere that the interface slips.",
    quotation=r"almost everywhere in space throughout the dynamics",
    method="part of the creep patch, over time up to the onset, where dphi/dt differs by less than "
    "10 %; the worst run with the slip law", said=words("almost everywhere"),
)  # fmt: skip
def slip_law_approximation(evidence: Evidence) -> Result:
    return _well_approximated(evidence, "state_rate_share_patch")


@claim(
    CLAIMS, id="slip-law-approximation-ahead", where="Text S2.1, below Eq. (S-phi_slip)",
    statement="The same almost everywhere in space, by the relative error, also where nothing "
    "slips.",
    quotation=r"almost everywhere in space throughout the dynamics",
    method="the same part of the whole interface", said=words("almost everywhere"),
)  # fmt: skip
def slip_law_approximation_ahead(evidence: Evidence) -> Result:
    note = (
        "A harsh reading: ahead of the front v is far below v0, which there decides how little the "
        "interface heals (findings: The slip law ahead of the front)."
    )
    return _well_approximated(evidence, "state_rate_share", note)


@claim(
    CLAIMS, id="weakening-at-v", where="Sect. 3",
    statement="Friction is velocity-weakening at V, zeta > 0.",
    quotation=r"hence we consider $\zeta>0$",
    method="zeta of the full law at V", said=above(0.0),
)  # fmt: skip
def weakening_at_v(evidence: Evidence) -> Ours:
    return Ours.exactly(evidence.friction.expansion(evidence.loading.velocity).zeta)
