"""From YAML to checked settings and runs; every problem is found before any work starts.

It uses the packages of physics below it, but never the compiled solver.
"""
