"""Elastic bodies by finite elements, condensed on their interface: no friction and no time.

It uses :mod:`nucleation.model`; a further body goes here.
"""
