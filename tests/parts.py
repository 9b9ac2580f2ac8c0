"""Runs with other parts, which tests keep as objects."""

import copy
import dataclasses


def law_values(law):
    """The parameters of a friction law by their names in runs."""
    return {law.called.get(name, name): value for name, value in dataclasses.asdict(law).items()}


def with_parts(run, law=None, **parts):
    """The run with another friction law, perturbation, heterogeneity or stepping."""
    run = copy.copy(run if law is None else run.replaced(**law_values(law)))
    for name, part in parts.items():
        object.__setattr__(run, name, part)
    return run
