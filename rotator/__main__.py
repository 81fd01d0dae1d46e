"""`python -m rotator` is the command `rotator`."""

from rotator.cli.main import main

main()
