"""A front panel: the orders that its switches and knobs give, and the threads that read them."""
