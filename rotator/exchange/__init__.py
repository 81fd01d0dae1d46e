"""What the rooms exchange: one order, its sender, and one status, as values that every room may know."""
