"""Simulated mjbots moteus controllers, from the line on the serial port to the trajectory of the shaft."""
