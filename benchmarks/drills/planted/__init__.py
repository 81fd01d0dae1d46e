"""Bugs planted on purpose, as patches: they show that the campaign of `benchmarks.drills` finds bugs.

`patch` knows what a patch is and puts it into a tree of source; `hunt` runs the campaign on a copy with one bug in it;
`__main__` is the command. The patches lie beside these files: each says in words what is wrong, and which judge of the
campaign is to see it.
"""
