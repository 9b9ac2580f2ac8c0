"""The rule of verdicts on made-up numbers: each verdict, each boundary."""

import math

import pytest

from replication.claims import table
from replication.claims.verdicts import (
    FORMULA_TOLERANCE,
    REASONED,
    WIDEST_ALLOWANCE,
    WORDS,
    Missing,
    Result,
    Verdict,
    between,
    formula,
    holds,
    judge,
    near_one,
    read,
)
from replication.claims.verdicts import worst as least_favourable


def number(printed):
    return read({"number": printed})


def words(expression):
    return read({"words": expression})


BELOW, ABOVE = read({"below": 1.0}), read({"above": 1.0})


@pytest.mark.parametrize(
    ("printed", "low", "high"),
    [
        ("13", 12.5, 13.5),
        ("0.0156", 0.01555, 0.01565),
        ("-1", -1.5, -0.5),
        ("0.40", 0.395, 0.405),
        ("4e3", 3500.0, 4500.0),
    ],
)
def test_printed_number_allows_half_a_unit_of_its_last_digit(printed, low, high):
    expected = number(printed)
    assert (expected.low, expected.high) == pytest.approx((low, high), rel=1e-12)
    assert holds(expected, between(low)) and holds(expected, between(high))
    beyond = 1e-9 * abs(high)
    assert not holds(expected, between(low - beyond))
    assert not holds(expected, between(high + beyond))


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
        (BELOW, (0.999, 0.5, 2.0), True),
        (BELOW, (1.0, 1.0, 1.0), False),
        (ABOVE, (1.001, 1.001, 1.001), True),
        (ABOVE, (1.0, 1.0, 9.0), False),
    ],
)
def test_a_range_widens_a_number_on_its_own_side_and_no_bound(expected, ours, held):
    assert holds(expected, between(*ours)) is held


@pytest.mark.parametrize("value", [math.pi, -2.0, 0.0, 1e-9])
def test_formula_holds_to_its_tolerance(value):
    margin = FORMULA_TOLERANCE * (abs(value) or 1.0)
    expected = formula(value)
    assert holds(expected, between(value + 0.99 * margin))
    assert not holds(expected, between(value + 1.01 * margin))
    assert not holds(expected, between(value - 1.01 * margin))


def test_words_are_intervals_with_a_reading():
    for expression, (low, high, reading) in WORDS.items():
        expected = words(expression)
        assert low < high and reading in expected.text
        assert holds(expected, between((low + min(high, 2.0 * abs(low))) / 2.0))
        assert not holds(expected, between(low))
        if math.isfinite(high):
            assert not holds(expected, between(high))
    with pytest.raises(KeyError):
        words("quite nice")
    with pytest.raises(ValueError, match="no known kind"):
        read({"figure": 3})


@pytest.mark.parametrize(
    ("expected", "worst", "low", "high"),
    [
        (words("computed"), 0.9, 0.9, 1.05),
        (words("small variation"), 1.05, 0.9, 1.05),
        (number("1.1"), 0.9, 0.9, 1.05),
        (formula(1.0), 0.9, 0.9, 0.9),
        (ABOVE, 0.9, 0.9, 1.05),
        (BELOW, 1.05, 0.9, 1.05),
    ],
)
def test_the_least_favourable_of_several_numbers_is_judged(expected, worst, low, high):
    assert least_favourable(expected, [0.9, 1.05, 1.0]) == (worst, low, high)
    assert least_favourable(expected, 0.9) == between(0.9)
    own = [between(0.9, 0.7, 1.1), between(1.05, 0.95, 1.15), between(1.0)]
    assert least_favourable(expected, own) == next(one for one in own if one[0] == worst)
    assert math.isnan(least_favourable(expected, [1.0, math.nan])[0])
    with pytest.raises(ValueError):
        least_favourable(expected, [])


THIRTEEN = number("13")
GOOD, BAD = 12.8, 18.9


@pytest.mark.parametrize(
    ("result", "verdict", "words_of_reason"),
    [
        (Result(GOOD), Verdict.REPLICATED, "12.8 is within 12.5 to 13.5."),
        (Result(between(13.6, 13.4)), Verdict.WIDENED, "outside 12.5 to 13.5, but by less"),
        (Result(GOOD, papers=BAD), Verdict.REPLICATED, "On its mesh it does not hold, with 18.9"),
        (Result(BAD), Verdict.NOT_REPLICATED, "18.9 is outside 12.5 to 13.5."),
        (Result(BAD, papers=GOOD), Verdict.NOT_REPLICATED, "On its mesh it holds, with 12.8"),
        (Result(BAD, explained=(GOOD, "Why.")), Verdict.EXPLAINED, "Why."),
        (Result(BAD, explained=(BAD, "Why.")), Verdict.NOT_REPLICATED, "outside"),
        (Result(GOOD, explained=(BAD, "Why.")), Verdict.REPLICATED, "within"),
        (Result(math.nan), Verdict.UNCHECKED, "no such event"),
        (Result(between(0.9, 0.8, 1.1), BELOW), Verdict.REPLICATED, "across the bound, 1."),
        (Result(between(1.05, 0.9, 1.1), BELOW), Verdict.NOT_REPLICATED, "the bound, 1."),
        (Result(BAD, explained=(math.nan, "Why.")), Verdict.NOT_REPLICATED, "outside"),
        (Result(-99.0, words("expected")), Verdict.NOT_SUPPORTED, "within 25 % of one"),
        (Result(-99.0, words("small variation")), Verdict.NOT_REPLICATED, "10 %"),
    ],
)
def test_verdicts(result, verdict, words_of_reason):
    found, reason = judge(result.expected or THIRTEEN, result._replace(mesh="its mesh"))
    assert found == verdict
    assert words_of_reason in reason
    assert set(REASONED) < set(WORDS)


def test_numbers_near_one_are_counted_beside_a_verdict():
    """ "Reasonably good" was read as within 40 %, made from the paper's own 0.64."""
    assert (
        near_one([0.64, 0.72, 1.02]) == "within 40, 33, 30, 25, 10 % of one are 3, 2, 2, 1, 1 of 3"
    )
    assert near_one(0.8) == "the difference from one is 20 %"
    verdict, reason = judge(THIRTEEN, Result(GOOD, beside="Others are 3."))
    assert verdict == Verdict.REPLICATED and reason.endswith("13.5. Others are 3.")


def made_up(monkeypatch, compute, expected=None, **more):
    monkeypatch.setitem(table.NUMBERS, "made-up", compute)
    entry = {"where": "", "statement": "It is 13.", "quotation": "$13$", "method": "", "unit": "s"}
    entry["decided_by"] = "formula"
    if expected:
        entry["expected"] = expected
    return table.evaluate_one("made-up", entry | more, None)


def test_missing_result_gives_no_number(monkeypatch):
    def compute(evidence):
        raise Missing("There is no such run")

    row = made_up(monkeypatch, compute, {"number": "13"})
    assert row["verdict"] == Verdict.UNCHECKED and row["reason"] == "There is no such run."
    assert row["ours"] is None and row["uncertainty"] is None and row["paper"] == "13"
    row = made_up(monkeypatch, lambda evidence: math.nan, {"number": "13"})
    assert row["verdict"] == Verdict.UNCHECKED and row["uncertainty"] is None


def test_row_has_number_range_and_the_functions_own_expected_range(monkeypatch):
    row = made_up(monkeypatch, lambda evidence: between(12.8, 12.7, 12.9), {"number": "13"})
    assert (row["ours"], row["uncertainty"], row["unit"]) == (12.8, [12.7, 12.9], "s")
    assert row["paper"] == "13" and row["verdict"] == "replicated"
    other = Result(2.0, BELOW, papers=0.5, mesh="its mesh")
    row = made_up(monkeypatch, lambda evidence: other, {"number": "13"})
    assert row["paper"] == "< 1" and row["on_papers_mesh"] == 0.5
    assert row["verdict"] == "not replicated"
    with pytest.raises(ValueError, match="made-up has nothing"):
        made_up(monkeypatch, lambda evidence: GOOD)


def test_a_statement_carried_to_another_problem_is_not_supported_where_it_fails(monkeypatch):
    def found(value, **more):
        return made_up(monkeypatch, lambda evidence: value, {"below": 1.0}, **more)["verdict"]

    assert found(0.9, carried=True) == found(0.9) == Verdict.REPLICATED
    assert found(1.1, carried=True) == Verdict.NOT_SUPPORTED
    assert found(1.1) == Verdict.NOT_REPLICATED


def test_inputs_have_a_verdict_of_their_own(monkeypatch):
    def found(value):
        return made_up(monkeypatch, lambda evidence: value, {"number": "400"}, input=True)

    assert found(400.0)["verdict"] == Verdict.GIVEN
    assert found(400.0)["reason"].startswith("It is an input of the paper and of our runs.")
    assert found(80.0)["verdict"] == Verdict.UNCHECKED
