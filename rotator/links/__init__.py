"""Serial ports, pseudo-terminals and sockets: they move bytes and decide nothing."""
