"""What opens the relays when the program cannot."""
