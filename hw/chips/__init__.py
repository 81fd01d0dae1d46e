"""One driver a chip."""
