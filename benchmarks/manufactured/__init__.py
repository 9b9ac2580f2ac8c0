"""Manufactured solutions: freely chosen fields, and the solver's own steps under their loads."""
