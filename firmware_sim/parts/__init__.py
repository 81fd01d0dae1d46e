"""Simulated motors, pots, contacts and servos."""
