"""Tables of many runs that have L_s or the law of the drop beside the simulated lengths."""
