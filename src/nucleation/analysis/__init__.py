"""Analysis of recorded runs: onset, critical length, tables, convergence, sensitivity.

It uses :mod:`nucleation.simulation` and the wings below.
"""
