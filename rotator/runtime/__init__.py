"""The threads of the running box and what they share."""
