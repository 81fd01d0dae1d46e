"""What the rooms exchange: an order, its sender, a fault, the status, as values that every room may know.

Also the rule by which two rooms judge alike whether a program still sends the same satellite (`program_clock`).
"""
