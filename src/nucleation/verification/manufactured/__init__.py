"""Manufactured solutions: fields chosen freely, and the solver's own steps under their loads.

:mod:`.fields` are displacements with exact derivatives and the forces they need, and
:mod:`.dynamics` the solver with its interface prescribed, or frictional with a source in the
state equation. The orders are measured in :mod:`nucleation.verification.orders`.
"""
