"""Where a target will be: elements, places on the earth, Sun and Moon, passes. Knows no rotor, no clock, no thread."""
