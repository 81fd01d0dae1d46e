"""A flood of half-open requests: `python -m tests.web.flood PORT COUNT`, as many machines of a network would send it.

Each begins a request and never ends it. Prints a line when they are under way, and one when all have come. It goes when
its standard input ends.
"""

from __future__ import annotations

import asyncio
import contextlib
import resource
import sys

MACHINES = 250
UNDER_WAY = 500
AT_A_TIME = 400
BEGUN = b"POST /api/point HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Slow: "


async def main(port: int, count: int) -> None:
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
    free, begun = asyncio.Semaphore(AT_A_TIME), []

    async def begin(number: int) -> None:
        # The box may have closed it before it is written.
        async with free:
            with contextlib.suppress(ConnectionError):
                source = (f"127.0.1.{1 + number % MACHINES}", 0)
                _, writer = await asyncio.open_connection("127.0.0.1", port, local_addr=source)
                begun.append(writer)
                writer.write(BEGUN)
        if number == UNDER_WAY:
            say("under way")

    await asyncio.gather(*(begin(number) for number in range(count)))
    say("all have come")
    await asyncio.to_thread(sys.stdin.read)


def say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    asyncio.run(main(*map(int, sys.argv[1:])))
