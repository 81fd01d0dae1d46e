"""What goes over the links, copied for a person to read."""
