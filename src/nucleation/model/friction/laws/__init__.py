"""The laws of the friction coefficient, one file each; its name is the law's name.

They use :mod:`nucleation.model.friction.law` and :mod:`nucleation.model.quantities`.
"""
