"""Prepares the Pi itself: the changes to its system files that the box needs."""
