"""Notices for a person who does not look at the box: before a pass, at a fault, at a stop."""
