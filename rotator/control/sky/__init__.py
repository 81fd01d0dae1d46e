"""From a direction in the sky to axis angles."""
