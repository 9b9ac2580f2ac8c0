"""Figures: functions from datasets to matplotlib figures, and the catalogue of all figures.

Figures of the paper are in :mod:`.paper`, further ones in :mod:`.beyond`, and those that support
the solver in :mod:`.checks`. ``nucleation.pictures.style`` has sizes, fonts and
colours, and :mod:`.laws` marks runs by their friction law.
"""
