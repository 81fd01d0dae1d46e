"""The simulated world on which the real drivers and protocols run: buses, chips, motors, rotors, an Arduino.

Knows hardware as the datasheets describe it. Does not know the program: it imports neither `rotator` nor `hw`, because
a mistake in a shared table would stay hidden.
"""
