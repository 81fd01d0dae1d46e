"""What runs beside the box while `busy` measures it: programs that ask, and processes that compile.

Knows the rotctld protocol's question. Knows no box.
"""

from __future__ import annotations

import asyncio
import random
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from pathlib import Path

from tests.boxes import free_port

COMPILES = "s = open(__import__('argparse').__file__).read()\nwhile True: compile(s, 's', 'exec')"
FIXED = """
import asyncio, sys
async def answer(reader, writer):
    while await reader.readline(): writer.write(b"235.00\\n25.00\\n")
async def main():
    async with await asyncio.start_server(answer, "127.0.0.1", int(sys.argv[1])) as server: await server.serve_forever()
asyncio.run(main())
"""


@contextmanager
def compiling(count: int, group: Path) -> Iterator[None]:
    """So many processes in the group, each of which compiles without a pause."""
    hogs = [subprocess.Popen([sys.executable, "-c", COMPILES]) for _ in range(count)]
    try:
        for hog in hogs:
            (group / "cgroup.procs").write_text(str(hog.pid))
        yield
    finally:
        for hog in hogs:
            hog.kill()
            hog.wait()


@asynccontextmanager
async def programs(port: int, count: int) -> AsyncIterator[list[float]]:
    """So many ask for the position ten times a second, and one asks and never reads. Gives the times of the answers."""
    answers_ms: list[float] = []

    async def asks() -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        due_s = time.monotonic() + random.random() * 0.1
        while True:
            await asyncio.sleep(max(0.0, due_s - time.monotonic()))
            due_s, began_s = due_s + 0.1, time.monotonic()
            writer.write(b"p\n")
            await reader.readline()
            await reader.readline()
            answers_ms.append(1000 * (time.monotonic() - began_s))

    async def never_reads() -> None:
        _, writer = await asyncio.open_connection("127.0.0.1", port, limit=1024)
        writer.transport.pause_reading()  # type: ignore[attr-defined]
        while not writer.transport.is_closing():
            writer.write(b"p\n" * 50)
            await asyncio.sleep(0.01)

    tasks = [asyncio.create_task(asks()) for _ in range(count)]
    tasks += [asyncio.create_task(never_reads())] if count > 1 else []
    yield answers_ms
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


async def fixed_answers_ms(count: int, seconds: float) -> list[float]:
    """The reference: the same programs and a server that sends a fixed answer."""
    port = free_port()
    with subprocess.Popen([sys.executable, "-c", FIXED, str(port)]) as server:
        await asyncio.sleep(1.0)
        async with programs(port, count) as answers_ms:
            await asyncio.sleep(seconds)
        server.kill()
    return answers_ms
