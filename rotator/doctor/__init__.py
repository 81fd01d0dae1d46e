"""`rotator doctor`: looks at the whole box, from the supply to the pots, and says what to do about what is wrong."""
