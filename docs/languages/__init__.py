"""Keeps the catalogues of `rotator/languages` in step with the texts of the program: `make languages`."""
