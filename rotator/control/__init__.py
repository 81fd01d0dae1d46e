"""What decides. Time is an argument: no clock, no thread, no input or output in here."""
