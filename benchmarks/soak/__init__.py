"""A soak: a busy box for an hour in real time, with flat memory."""
