"""A front panel: what its switches and knobs ask for, and the threads that look at them."""
