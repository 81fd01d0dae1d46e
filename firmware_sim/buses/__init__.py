"""Simulated GPIO lines and I2C."""
