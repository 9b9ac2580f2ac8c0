"""The same runs by an independent solver, FreeFem++: see README.md."""
