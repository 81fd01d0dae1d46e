"""A process that has loaded the program and starts it as often as it is asked: on this slow machine loading takes long.

Knows how a child becomes a process of its own. What runs in it is the program's own command line, from its beginning.

One line in: a JSON list, the module whose `main` runs, the log's path, what the environment says besides, and the
arguments. One line out: the child's process id.
"""

from __future__ import annotations

import importlib
import json
import os
import signal
import sys


def tell(word: str) -> None:
    os.write(1, word.encode() + b"\n")


def run(module: str, log: str, environment: dict[str, str], arguments: list[str]) -> None:
    os.setsid()
    os.environ |= environment
    with open(log, "ab", buffering=0) as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
    os.close(0)
    sys.argv = ["rotator", *arguments]
    importlib.import_module(module).main()


if __name__ == "__main__":
    for program in ("rotator.cli.main", "rotator.cli.run", "rotator.cli.off"):
        importlib.import_module(program)  # loaded here, used by the children

    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # nobody waits for the dead
    tell("ready")
    for line in sys.stdin:
        module, log, environment, *arguments = json.loads(line)
        child = os.fork()
        if child == 0:
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            run(module, log, environment, arguments)
            sys.exit()
        tell(str(child))
