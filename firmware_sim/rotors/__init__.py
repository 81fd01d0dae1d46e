"""Simulated rotors, one file a kind; `rotor` is what all kinds share, `geared` what those with gears share."""
