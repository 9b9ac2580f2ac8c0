"""The paper's formulas as printed, and evaluations that use none of the project's own."""
