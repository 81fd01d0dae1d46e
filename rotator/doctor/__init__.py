"""`rotator doctor`: checks the whole box, from the supply to the pots, and advises what to do about each fault."""
