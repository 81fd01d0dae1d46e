"""Setting an axis up with the operator: the questions, the checks on readings, and what is saved in the file."""
