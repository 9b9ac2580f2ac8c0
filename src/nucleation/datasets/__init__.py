"""Files: how datasets are written and read, and the metadata of their variables and origin.

This wing imports nothing else of the package.
"""


class DatasetError(ValueError):
    """A variable is not declared, or results or their code are damaged, changed or foreign."""
