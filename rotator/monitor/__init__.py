"""A copy of all bytes on the links, as text for the operator."""
