"""The length at the drop by theory: the law of the drop under a declared perturbation."""
