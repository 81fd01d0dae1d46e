"""Drivers of chips on I2C, SPI and GPIO lines, one file a chip. They do not know what a chip is wired to."""
