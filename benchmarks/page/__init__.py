"""Fifty browsers at once: `python -m benchmarks.page`."""
