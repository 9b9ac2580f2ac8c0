"""One run: friction, bodies and loads advanced in time, controlled, recorded, kept in checkpoints.

It uses :mod:`nucleation.model`, :mod:`nucleation.fem`.
"""
