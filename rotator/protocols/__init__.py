"""From bytes to orders and replies. No sockets, files, threads, clocks or logging in this package."""
