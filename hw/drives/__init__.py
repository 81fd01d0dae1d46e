"""Drivers of motors: relays, servos, control boxes with a digital potentiometer. They know no sensor and no target."""
