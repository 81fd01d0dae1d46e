"""Serial ports, pseudo-terminals, sockets and files: they move bytes and do not know what the bytes mean."""
