"""A soak: a busy box for an hour in real time, and 24 hours of passes in simulated time, both with flat memory."""
