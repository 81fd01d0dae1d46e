"""Stops the box from outside: `python -m benchmarks.page.finger PAGE_PORT LINK_PORT`.

At a line `POST` it presses STOP as the page does, on a new connection; at a line `S` it sends `S` on the link of a
GS-232 program. Prints the moment before, on the clock that all processes of a computer share.
"""

from __future__ import annotations

import argparse
import http.client
import socket
import sys
import time


def main(page_port: int, link_port: int) -> None:
    link = socket.create_connection(("127.0.0.1", link_port))
    link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    for line in sys.stdin:
        sent_s = time.monotonic()
        if line == "S\n":
            link.sendall(b"S\r")
        else:
            page = http.client.HTTPConnection("127.0.0.1", page_port)
            page.request("POST", "/api/stop")
            assert page.getresponse().status == 200
            page.close()
        print(sent_s, flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page_port", type=int)
    parser.add_argument("link_port", type=int)
    asked = parser.parse_args()
    main(asked.page_port, asked.link_port)
