"""The box in real time, as a process of its own, and what is measured of it: `busy`, `soak` and `fuzz`."""
