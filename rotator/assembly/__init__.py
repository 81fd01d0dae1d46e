"""The larger half of the composition root: from the file to settings, chips, drivers and rotors, real or not."""
