"""Do the tests see a change of the source? Cosmic Ray changes it, one place at a time, and the tests must fail."""
