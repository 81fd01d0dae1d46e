"""Fetches elements of satellites from the network, seldom. Knows nothing of the antenna; control never waits for it."""
