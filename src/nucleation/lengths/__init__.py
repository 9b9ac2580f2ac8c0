"""Answers about a fault: nucleation lengths in use, their uncertainty, and inverse problems.

They are based on the theory of homogeneous sliding and of the creeping patch
(:mod:`nucleation.theory`).
"""
