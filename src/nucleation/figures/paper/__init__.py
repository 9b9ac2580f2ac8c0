"""The paper's figures and table.

One module each, with a function ``draw``.
"""
