"""Files that survive the end of the program: counts, learnt motors, knobs, the compass's corrections."""
