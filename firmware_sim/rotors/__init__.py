"""Simulated rotors, one file a kind."""
