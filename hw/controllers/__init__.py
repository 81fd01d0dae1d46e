"""Ready-made rotor controllers on a serial port or TCP: their bytes, one conversation each, and the drive over them."""
