"""The driver of two moteus motor controllers on CAN-FD."""
