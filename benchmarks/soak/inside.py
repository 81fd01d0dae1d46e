"""`rotator` as a user starts it, with one more thread that says what the process holds.

Run as `python -m benchmarks.soak.inside SOCKET LOG run --config FILE`. Each connection to the Unix socket SOCKET is
answered with one line of JSON, after a garbage collection: threads by name, asyncio tasks, blocks of Python's memory.
From the first connection on, the log goes to the file LOG too: a picture in a terminal shows only its last rows.
"""

from __future__ import annotations

import asyncio
import gc
import json
import logging
import socket
import sys
import threading
from pathlib import Path

from rotator.__main__ import main as rotator

PROBE = "probe"
"""The name of the thread that is not the box's own."""


def answer_all(listener: socket.socket, log: Path) -> None:
    events: asyncio.AbstractEventLoop | None = None
    while True:
        connection, _ = listener.accept()
        with connection:
            if events is None:
                events = running_loop()
                handler = logging.FileHandler(log)
                handler.setFormatter(logging.Formatter("%(asctime)s %(levelname).1s %(message)s"))
                logging.getLogger().addHandler(handler)
            gc.collect()
            holds = {
                "threads": sorted(thread.name for thread in threading.enumerate() if thread.name != PROBE),
                "tasks": len(asyncio.all_tasks(events)),
                "blocks": sys.getallocatedblocks(),
            }
            connection.sendall(json.dumps(holds).encode() + b"\n")


def running_loop() -> asyncio.AbstractEventLoop:
    return next(each for each in gc.get_objects() if isinstance(each, asyncio.BaseEventLoop) and each.is_running())


def main() -> None:
    place, log, *command = sys.argv[1:]
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(place)
    listener.listen()
    threading.Thread(target=answer_all, args=(listener, Path(log)), name=PROBE, daemon=True).start()
    sys.argv = ["rotator", *command]
    rotator()


if __name__ == "__main__":
    main()
