"""Simulated GPIO lines in the shape of gpiod, and a simulated I2C adapter in the shape of smbus2."""
