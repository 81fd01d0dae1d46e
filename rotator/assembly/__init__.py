"""The composition root: from the configuration to settings, drivers and rotors, on real or simulated hardware."""
