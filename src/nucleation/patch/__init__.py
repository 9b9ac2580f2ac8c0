"""The creeping patch itself: its spectrum when frozen, and the law of the drop.

Tables of many runs beside these are in :mod:`.tables`.
"""
