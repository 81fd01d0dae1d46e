"""Prepares the Pi itself: what has to stand in the system's files before the box can run well on it."""
