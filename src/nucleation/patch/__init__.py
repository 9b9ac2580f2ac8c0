"""The creeping patch's own stability: its spectrum when frozen, and the law of the drop."""
