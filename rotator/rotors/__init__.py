"""The kinds of rotor, each as the control loop sees one: a drive, its sensors, and what only it can say or do."""
