"""From chips and lines to an angle, a count or a switch."""
