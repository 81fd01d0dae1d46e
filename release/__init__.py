"""What is handed out: the wheel, the sdist, the Debian package with the list of its parts. `make dist`, `make deb`."""
