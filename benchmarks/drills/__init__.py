"""Drills: simulated hours at random, judged in the simulated world alone. Run `python -m benchmarks.drills`."""
