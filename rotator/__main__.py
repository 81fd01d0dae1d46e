"""The command `rotator`, also as `python -m rotator`: a stop goes the short way, all else loads what it needs."""

from __future__ import annotations

import sys

INTERRUPTED = 130
"""The exit code of a program that Ctrl-C ended."""


def main() -> None:
    try:
        _run()
    except KeyboardInterrupt:  # while the program still loads or starts: later each command handles it itself
        sys.exit(INTERRUPTED)


def _run() -> None:
    if sys.argv[1:2] == ["stop"]:
        from rotator.cli.stop import STOPPED, stop_at_once  # noqa: PLC0415 - a command loads what it needs and no more

        if stop_at_once(sys.argv[2:]):
            sys.stdout.write(f"{STOPPED}\n")
            return
    from rotator.cli import main as commands  # noqa: PLC0415 - loads click and the model

    commands.main()


if __name__ == "__main__":
    main()
