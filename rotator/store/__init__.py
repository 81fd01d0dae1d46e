"""Files that survive the end of the program: the state, counts, pairings, and what is fetched, sent or flown."""
