"""Figures and tables of the paper: datasets in, matplotlib figures out.

Every module ``figure_*`` has one function ``draw`` that takes datasets and returns a
:class:`matplotlib.figure.Figure`; :func:`nucleation.figures.style.save` writes it. Nothing
scientific is computed here: what is drawn was computed before and is read from the datasets.
"""
