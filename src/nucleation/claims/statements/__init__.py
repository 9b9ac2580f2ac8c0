"""The paper's statements, by subject."""
