"""Simulated motors, relays, pots, contacts and servos: mechanics, without chips and protocols."""
