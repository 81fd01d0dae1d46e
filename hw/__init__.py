"""The hardware layer: interfaces in `ports`, and one small driver for each device. It does not know the program."""
