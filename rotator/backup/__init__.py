"""A backup of the box in one file, and the way back."""
