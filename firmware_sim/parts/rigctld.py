"""A look-alike of Hamlib's rigctld on a TCP port of its own: it answers the questions for a receiver's strength.

Knows the two questions and the answers of the real one. Knows no radio: a function tells it the strength.
"""

from __future__ import annotations

import socketserver
import threading
from collections.abc import Callable

NOT_THERE = b"RPRT -11\n"


class SimRigctld:
    """It listens until it is closed."""

    def __init__(self, strength_db: Callable[[], float]) -> None:
        class Client(socketserver.StreamRequestHandler):
            def handle(self) -> None:
                for line in self.rfile:
                    self.wfile.write(_answer(line.decode("latin-1").split(), strength_db))

        self._server = socketserver.ThreadingTCPServer(("127.0.0.1", 0), Client)
        self._server.daemon_threads = True
        self._thread = threading.Thread(
            target=self._server.serve_forever, args=(0.1,), name="simulated-receiver", daemon=True
        )
        self._thread.start()

    @property
    def place(self) -> tuple[str, int]:
        host, port = self._server.server_address[:2]
        return str(host), int(port)

    def close(self) -> None:
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


def _answer(words: list[str], strength_db: Callable[[], float]) -> bytes:
    match words:
        case ["\\chk_vfo"]:
            return b"0\n"
        case ["l" | "\\get_level", "STRENGTH"]:
            return f"{strength_db():.0f}\n".encode()
        case _:
            return NOT_THERE
