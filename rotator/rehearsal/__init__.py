"""A pass flown against the simulated rotor in simulated time."""
