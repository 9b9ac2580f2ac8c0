"""The same runs by an independent solver, FreeFem++: their plan, its runs, the comparison."""
