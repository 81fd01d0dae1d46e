"""Motors: relays, servos, digital pots."""
