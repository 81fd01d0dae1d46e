"""GPIO lines, I2C and SPI."""
