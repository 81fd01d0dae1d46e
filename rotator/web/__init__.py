"""The page of the box, and its API: it knows the status, the orders and who may give them, and no hardware."""
