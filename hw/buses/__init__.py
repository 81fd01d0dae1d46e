"""Drivers of GPIO lines, I2C and SPI: the only importers of gpiod, smbus2 and spidev. They know no chip."""
