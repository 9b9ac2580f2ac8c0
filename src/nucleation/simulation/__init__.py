"""One run: friction, bodies and loads, advanced in time, recorded and kept in checkpoints.

It uses :mod:`nucleation.model`, :mod:`nucleation.datasets` and :mod:`nucleation.fem`; the progress
of a run also uses :mod:`nucleation.theory`.
"""
