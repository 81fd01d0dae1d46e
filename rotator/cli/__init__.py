"""The command line: `rotator` and its sub-commands."""
