"""Drivers of sensors: from chips and GPIO lines to an angle, a count or a switch. They switch no motor."""
