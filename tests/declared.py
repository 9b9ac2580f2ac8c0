"""What all modules declare of their datasets' variables."""

import importlib
import inspect
import pkgutil

from nucleation.datasets.variables import Column

ROOMS = ("nucleation", "replication")


def declarations():
    """Mappings of names to columns by module and name of the mapping."""
    found = {}
    for room in ROOMS:
        package = importlib.import_module(room)
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if module.name.endswith("__main__"):
                continue
            imported = importlib.import_module(module.name)
            source = inspect.getsource(imported)
            if "Column(" not in source and "columns(" not in source:
                continue  # it has what others declare
            for name, value in vars(imported).items():
                if isinstance(value, dict) and any(isinstance(v, Column) for v in value.values()):
                    found[module.name, name] = value
    return found


VARIABLES = {name: entry for own in declarations().values() for name, entry in own.items()}
