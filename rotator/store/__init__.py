"""What must survive the end of the program."""
