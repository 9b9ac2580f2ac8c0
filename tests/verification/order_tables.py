"""Errors and orders of a refinement, printed (shown with pytest -s)."""

import numpy as np

from nucleation.verification.orders import REFINEMENTS, SPACINGS, orders


def print_orders(title, labels, errors):
    """Print a line per level: its label, error and order."""
    print(f"\n{title}")
    for label, error, order in zip(labels, errors, [np.nan, *orders(errors)], strict=True):
        print(f"  {label:>14}  {error:10.3e}  {order:6.3f}")


def levels(dataset, refinement):
    """Labels of the levels of a refinement of the convergence dataset."""
    spacing = dict(zip(REFINEMENTS, SPACINGS, strict=True))[refinement]
    return [f"{value:.3e}" for value in dataset[spacing].values]
