"""Setting an axis up: what is asked of a person, what is believed of a reading, and the table that comes of it."""
