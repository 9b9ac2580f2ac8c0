"""The rule of verdicts on made-up numbers: each verdict, each boundary."""

import dataclasses
import math

import pytest

from replication.claims.claim import Claim, Result, Verdict, judge
from replication.claims.expected import (
    FORMULA_TOLERANCE,
    REASONED,
    WIDEST_ALLOWANCE,
    WORDS,
    Estimate,
    Missing,
    above,
    below,
    formula,
    holds,
    number,
    words,
)


@pytest.mark.parametrize(
    ("printed", "low", "high"),
    [
        ("13", 12.5, 13.5),
        ("0.15", 0.145, 0.155),
        ("0.0156", 0.01555, 0.01565),
        ("-1", -1.5, -0.5),
        ("0.40", 0.395, 0.405),
        ("4e3", 3500.0, 4500.0),
    ],
)
def test_printed_number_allows_half_a_unit_of_its_last_digit(printed, low, high):
    expected = number(printed)
    assert (expected.low, expected.high) == pytest.approx((low, high), rel=1e-12)
    assert holds(expected, Estimate.exactly(low)) and holds(expected, Estimate.exactly(high))
    beyond = 1e-9 * abs(high)
    assert not holds(expected, Estimate.exactly(low - beyond))
    assert not holds(expected, Estimate.exactly(high + beyond))


WIDEST = 0.155 + WIDEST_ALLOWANCE * 0.15


@pytest.mark.parametrize(
    ("expected", "ours", "held"),
    [
        (number("0.15"), (0.160, 0.155, 0.160), True),
        (number("0.15"), (0.160, 0.156, 0.200), False),  # its upper side is the wrong one
        (number("0.15"), (0.140, 0.140, 0.146), True),
        (number("0.15"), (0.140, 0.100, 0.144), False),
        (number("0.15"), (WIDEST - 1e-9, 0.01, 1.0), True),  # wide uncertainty does not confirm
        (number("0.15"), (WIDEST + 1e-9, 0.01, 1.0), False),
        (below(1.0), (0.999, 0.5, 2.0), True),
        (below(1.0), (1.0, 1.0, 1.0), False),
        (above(1.0), (1.001, 1.001, 1.001), True),
        (above(1.0), (1.0, 1.0, 9.0), False),
    ],
)
def test_a_range_widens_a_number_on_its_own_side_and_no_bound(expected, ours, held):
    assert holds(expected, Estimate.between(*ours)) is held


@pytest.mark.parametrize("value", [math.pi, -2.0, 0.0, 1e-9])
def test_formula_holds_to_its_tolerance(value):
    margin = FORMULA_TOLERANCE * (abs(value) or 1.0)
    expected = formula(value)
    assert holds(expected, Estimate.exactly(value + 0.99 * margin))
    assert not holds(expected, Estimate.exactly(value + 1.01 * margin))
    assert not holds(expected, Estimate.exactly(value - 1.01 * margin))
    assert holds(expected, Estimate.within(value, 1.01 * margin)) is None  # too uncertain to decide


def test_words_are_intervals_with_a_reading():
    for expression, (low, high, reading) in WORDS.items():
        expected = words(expression)
        assert low < high and reading in expected.text
        inside = (low + min(high, 2.0 * abs(low))) / 2.0
        assert holds(expected, Estimate.exactly(inside))
        assert not holds(expected, Estimate.exactly(low))
        if math.isfinite(high):
            assert not holds(expected, Estimate.exactly(high))
    with pytest.raises(KeyError):
        words("quite nice")


def test_undefined_number_decides_nothing():
    for expected in (number("1"), formula(1.0), below(1.0), words("most")):
        assert holds(expected, Estimate.exactly(math.nan)) is None


@pytest.mark.parametrize(
    ("expected", "worst", "low", "high"),
    [
        (words("computed"), 0.9, 0.9, 1.05),
        (words("small variation"), 1.05, 0.9, 1.05),
        (number("1.1"), 0.9, 0.9, 1.05),
        (formula(1.0), 0.9, 0.9, 0.9),
        (above(1.0), 0.9, 0.9, 1.05),
        (below(1.0), 1.05, 0.9, 1.05),
        (words("most"), 0.9, 0.9, 1.05),
    ],
)
def test_the_least_favourable_of_several_numbers_is_judged(expected, worst, low, high):
    assert expected.worst([0.9, 1.05, 1.0]) == Estimate(worst, low, high)
    assert expected.worst(0.9) == Estimate.exactly(0.9)
    own = [Estimate.within(0.9, 0.2), Estimate.within(1.05, 0.1), Estimate.exactly(1.0)]
    assert expected.worst(own) == next(one for one in own if one.value == worst)
    assert math.isnan(expected.worst([1.0, math.nan]).value)
    with pytest.raises(ValueError):
        expected.worst([])


THIRTEEN = number("13")
GOOD, BAD = Estimate.exactly(12.8), Estimate.exactly(18.9)


def because(ours, without):
    """Our number, and that without a possible cause."""
    return Result(ours, without_cause=without, cause="Without it", finding="Why")


@pytest.mark.parametrize(
    ("result", "verdict", "words_of_reason"),
    [
        (Result(GOOD), Verdict.REPLICATED, "12.8 is within 12.5 to 13.5."),
        (
            Result(Estimate.between(13.6, 13.4, 13.6)),
            Verdict.REPLICATED,
            "not outside it by more than",
        ),
        (Result(GOOD, on_papers_mesh=BAD), Verdict.REPLICATED, "it does not hold, with 18.9"),
        (Result(BAD), Verdict.NOT_REPLICATED, "18.9 is outside 12.5 to 13.5."),
        (Result(BAD, on_papers_mesh=GOOD), Verdict.NOT_REPLICATED, "holds as well, with 12.8"),
        (because(BAD, GOOD), Verdict.EXPLAINED, "(results: Why)"),
        (because(BAD, BAD), Verdict.NOT_REPLICATED, "outside"),
        (because(GOOD, BAD), Verdict.REPLICATED, "within"),
        (Result(Estimate.exactly(math.nan)), Verdict.UNCHECKED, "no such event"),
        (
            Result(Estimate.within(1.0, 0.01), formula(1.0)),
            Verdict.UNCHECKED,
            "known to 0.01 only.",
        ),
        (
            Result(Estimate.between(0.9, 0.8, 1.1), below(1.0)),
            Verdict.REPLICATED,
            "Its range reaches across the bound, 1.",
        ),
        (
            Result(Estimate.between(1.05, 0.9, 1.1), below(1.0)),
            Verdict.NOT_REPLICATED,
            "the bound, 1.",
        ),
        (
            because(BAD, Estimate.exactly(math.nan)),
            Verdict.NOT_REPLICATED,
            "outside",
        ),
    ],
)
def test_verdicts(result, verdict, words_of_reason):
    found, reason = judge(result.expected or THIRTEEN, result)
    assert found == verdict
    assert words_of_reason in reason


def test_words_with_a_chosen_reading_are_not_supported_where_others_are_not_replicated():
    def failing(expression):
        return judge(words(expression), Result(Estimate.exactly(-99.0)))[0]

    assert failing("expected") == failing("almost everywhere") == Verdict.NOT_SUPPORTED
    assert failing("reasonably good") == Verdict.NOT_REPLICATED
    assert failing("small variation") == failing("computed") == Verdict.NOT_REPLICATED
    assert set(REASONED) < set(WORDS)


def made_up(compute, expected=THIRTEEN):
    return Claim("made-up", "Sect. 1", "It is 13.", "$13$", "by hand", compute, expected, "s")


def test_missing_result_gives_no_number():
    def compute(evidence):
        raise Missing("There is no such run")

    row = made_up(compute).evaluate(None)
    assert row["verdict"] == Verdict.UNCHECKED and row["reason"] == "There is no such run."
    assert row["ours"] is None and row["uncertainty"] is None and row["paper"] == "13"


def test_row_has_number_range_and_the_functions_own_expected_range():
    row = made_up(lambda evidence: Estimate.between(12.8, 12.7, 12.9)).evaluate(None)
    assert (row["ours"], row["uncertainty"], row["unit"]) == (12.8, [12.7, 12.9], "s")
    assert row["paper_range"] == [12.5, 13.5] and row["verdict"] == "replicated"
    other = Result(Estimate.exactly(2.0), expected=below(1.0), on_papers_mesh=Estimate.exactly(0.5))
    row = made_up(lambda evidence: other).evaluate(None)
    assert row["paper_range"] == [None, 1.0] and row["on_papers_mesh"] == 0.5
    assert row["verdict"] == "not replicated"
    with pytest.raises(ValueError, match="made-up has nothing"):
        made_up(lambda evidence: GOOD, expected=None).evaluate(None)


def test_a_statement_carried_to_another_problem_is_not_supported_where_it_fails():
    def judged(value, carried):
        claim = made_up(lambda evidence: Estimate.exactly(value), below(1.0))
        return dataclasses.replace(claim, carried=carried).evaluate(None)["verdict"]

    assert judged(0.9, True) == judged(0.9, False) == Verdict.REPLICATED
    assert judged(1.1, True) == Verdict.NOT_SUPPORTED
    assert judged(1.1, False) == Verdict.NOT_REPLICATED


def test_reasonably_good_includes_the_papers_own_example():
    """0.15 m at H = 0.005 m, where the paper's theory has 0.235 m, with the rounding of both."""
    for length in (0.145, 0.15, 0.155):
        for theory in (0.2345, 0.235, 0.2355):
            assert holds(words("reasonably good"), Estimate.exactly(length / theory))


def test_inputs_have_a_verdict_of_their_own():
    def judged(value):
        claim = Claim(
            "mesh",
            "Text",
            "It has 400.",
            "400",
            "given",
            lambda evidence: Estimate.exactly(value),
            number("400"),
            input=True,
        )
        return claim.evaluate(None)

    assert judged(400.0)["verdict"] == Verdict.GIVEN
    assert judged(400.0)["reason"].startswith("It is an input of the paper and of our runs.")
    assert judged(80.0)["verdict"] == Verdict.UNCHECKED
