"""Elastic bodies by finite elements, condensed on their interface: no friction and no time.

It uses :mod:`nucleation.model`. New elastic bodies belong here.
"""
