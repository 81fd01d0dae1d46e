"""Simulated mjbots moteus controllers, from the line on the serial port down to the trajectory of the shaft."""
