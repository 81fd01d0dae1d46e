"""Hardware that the kernel believes in: GPIO chips, an I2C adapter, a USB cable, a CAN bus, each in a file of its own.

Needs root and the modules of the stage. Knows nothing of the program, but for `contract`. A test may import it, and so
may a process that plays the rotor.
"""
