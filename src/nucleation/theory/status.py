"""Why there is no length: the words that answers of all kinds share.

A length that is NaN has one of four statuses beside it, and a reason in words.
"""

VALUE = "value"
"""There is a length."""

BETWEEN = "between"
"""The length is between the ends of its range; the reason says what would make it one number."""

STABLE = "stable"
"""Sliding is stable: no patch of any length nucleates."""

BEYOND = "beyond"
"""The length is longer than the longest that was searched; the reason says which that is."""

UNKNOWN = "unknown"
"""The theory or the formula does not apply to this fault."""

EDGE_ALONE = "it is known for a patch that is pushed at its edge"


class NoLength(ValueError):
    """This fault has no such length: L_c, L_s, L_run or the length at the drop.

    Parameters
    ----------
    reason : str
        Why, in words.
    status : {"stable", "beyond", "unknown"}
        The kind of reason.

    Examples
    --------
    >>> error = NoLength("no patch turns unstable", "stable")
    >>> str(error), error.status
    ('no patch turns unstable', 'stable')
    """

    def __init__(self, reason: str, status: str = UNKNOWN) -> None:
        super().__init__(reason)
        self.status = status
