"""Files: how datasets are written and read, and the metadata of their variables and origin.

This package imports no other one of the library.
"""


class DatasetError(ValueError):
    """A variable is not declared, or results or their code are damaged, changed or foreign."""
