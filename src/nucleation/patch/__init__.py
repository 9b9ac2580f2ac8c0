"""The creeping patch's own stability: its spectrum when frozen, its growth in twin runs.

It uses :mod:`nucleation.analysis`, :mod:`nucleation.theory` and what these use.
"""
