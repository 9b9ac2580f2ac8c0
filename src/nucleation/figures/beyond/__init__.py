"""Figures that the paper does not have.

One module each, with a function ``draw``.
"""
