"""Manufactured solutions: fields chosen freely, the solver's own steps under their loads."""
