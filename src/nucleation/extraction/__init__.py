"""From a recorded run to its onset, its lengths, and the stability of its frozen patch."""
