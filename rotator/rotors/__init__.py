"""The kinds of rotor, as the control loop sees them: a drive, its sensors, and what only that kind can report or do."""
