"""From YAML to checked settings and runs; every problem is found before any work starts.

The wing uses the wings of physics below it, but never the compiled solver.
"""
