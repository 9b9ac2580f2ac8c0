"""What is read from recorded runs: onset, critical length, tables, convergence, sensitivity.

It uses :mod:`nucleation.simulation` and what that uses.
"""
