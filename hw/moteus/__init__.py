"""Two moteus controllers on CAN-FD."""
