"""Simulated ready-made controllers: what they understand and answer, how they turn their motors, and their line."""
