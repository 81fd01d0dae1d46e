"""The command `rotator`, also as `python -m rotator`: a stop goes the short way, all else loads what it needs."""

from __future__ import annotations

import errno
import os
import signal
import sys

from rotator.cli.failed import INTERRUPTED, NOT_DONE

UNWRITTEN = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EPIPE)
"""The errors of a write to an open file or pipe: a full disk, a reader that has gone."""


def main() -> None:
    _open_closed_streams()
    _stand_somewhere()
    try:
        if signal.getsignal(signal.SIGINT) is signal.SIG_DFL:
            # As a launcher sets it while Python starts. From here on Ctrl-C is an exception: it stops the antenna.
            signal.signal(signal.SIGINT, signal.default_int_handler)
        _run()
    except KeyboardInterrupt:  # while the program still loads or starts: later each command handles it itself
        sys.exit(INTERRUPTED)
    except RuntimeError as fault:
        # So Python 3.11 tells of a Ctrl-C while a class is made.
        if not isinstance(fault.__cause__, KeyboardInterrupt):
            raise
        sys.exit(INTERRUPTED)
    except OSError as fault:
        if fault.filename is not None or fault.errno not in UNWRITTEN:
            raise
        _write_no_more()
        sys.stderr.write(f"rotator: the output cannot be written: {fault.strerror}\n")
        sys.exit(NOT_DONE)


def _open_closed_streams() -> None:
    """A caller may have closed standard input or output (`<&-`). Python then has no such stream, and the next file or
    relay line that is opened would get its number."""
    for fd, name, mode in ((0, "stdin", "r"), (1, "stdout", "w"), (2, "stderr", "w")):
        try:
            os.fstat(fd)
        except OSError:
            nothing = os.open(os.devnull, os.O_RDWR)
            if nothing != fd:
                os.dup2(nothing, fd)
                os.close(nothing)
        if getattr(sys, name) is None:
            setattr(sys, name, open(fd, mode, closefd=False))  # noqa: SIM115 - it stays open to the end


def _stand_somewhere() -> None:
    """The folder may have been deleted, and made anew by `git clone`: a stop works from there, too."""
    try:
        os.getcwd()
    except OSError:
        if sys.argv[1:2] != ["stop"]:
            sys.stderr.write("rotator: this folder has been deleted: go into another one, or into the new one (cd .)\n")
            sys.exit(NOT_DONE)
        os.chdir("/")


def _run() -> None:
    if sys.argv[1:2] == ["stop"] and _stopped(sys.argv[2:]):
        return
    from rotator.cli import main as commands  # noqa: PLC0415 - loads click

    commands.main()


def _stopped(arguments: list[str]) -> bool:
    from rotator.cli.failed import CommandFailed  # noqa: PLC0415 - a command loads what it needs and no more
    from rotator.cli.stop import stop_at_once  # noqa: PLC0415

    try:
        if not (said := stop_at_once(arguments)):
            return False
    except CommandFailed as fault:
        sys.stderr.write(f"rotator: {fault}\n")
        sys.exit(fault.exit_code)
    try:
        print(said, flush=True)  # noqa: T201
    except OSError:  # the disk is full, or the reader has gone: the antenna has stopped all the same
        _write_no_more()
        sys.stderr.write(f"rotator: {said}\n")
    return True


def _write_no_more() -> None:
    """Else Python writes what waits in standard output once more at its end, and complains."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


if __name__ == "__main__":
    main()
