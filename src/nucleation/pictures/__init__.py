"""Pictures: the style of all figures, and pictures of a run, a length or a spectrum in one call."""
