"""Simulated chips, at register level, as their datasheets describe them."""
