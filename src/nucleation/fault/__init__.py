"""A fault: its parameters, and every answer about it as a method."""

from .fault import Fault

__all__ = ["Fault"]
