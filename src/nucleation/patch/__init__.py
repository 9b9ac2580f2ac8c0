"""The creeping patch's own stability: its spectrum when frozen, its growth in twin runs."""
