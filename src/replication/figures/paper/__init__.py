"""The paper's figures and table, one module each, with a function ``draw``."""
