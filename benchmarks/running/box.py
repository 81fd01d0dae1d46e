"""A running box: `rotator run` as a process of its own, on its simulated rotor, with links of its own.

Knows how to start it, to ask it and its probe (`inside`), what the kernel says of the process, and how to end it.
Judges nothing.
"""

from __future__ import annotations

import asyncio
import json
import os
import signal
import subprocess
import sys
import time
import tty
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import tomlkit

from benchmarks.running.words import Words
from rotator.protocols.pstrotator import ANSWERS_ABOVE
from tests.boxes import free_port, free_udp_ports

PATIENCE_S = 30.0
TICKS_PER_S = os.sysconf("SC_CLK_TCK")


class Box:
    """`tables`: its configuration, without the links; `words`: a link for each of these.

    `in_terminal`: it shows its picture in a terminal; else its lines go to a file.
    """

    def __init__(
        self,
        folder: Path,
        tables: dict[str, Any],
        words: Sequence[Words],
        *,
        read_only: bool = False,
        in_terminal: bool = False,
    ) -> None:
        self.folder, self.words = folder, {each.protocol: each for each in words}
        self.config = folder / "rotator.toml"
        self.page_port = free_port()
        self.ports = {each.protocol: free_udp_ports() if each.place == "udp" else free_port() for each in words}
        self.serial, line = os.openpty()
        """Our end of the line whose other end is the box's serial port."""
        tty.setraw(line)
        self.terminal, screen = os.openpty() if in_terminal else (-1, -1)
        """Our end of the terminal in which the box runs."""
        links = [self._link(each, os.ttyname(line)) | ({"read_only": True} if read_only else {}) for each in words]
        files = {"state": {"path": f"{folder}/state.json"}, "page": {"listen": f"127.0.0.1:{self.page_port}"}}
        self.config.write_text(tomlkit.dumps({**tables, **files, "link": links}))
        command = [sys.executable, "-m", "benchmarks.running.inside", f"{folder}/probe", "run"]
        with Path(folder, "said.txt").open("wb") as said:
            self.process: subprocess.Popen[bytes] = subprocess.Popen(
                [*command, *([] if in_terminal else ["--plain"]), "--config", str(self.config)],
                stdout=screen if in_terminal else said,
                stderr=screen if in_terminal else said,
                stdin=screen if in_terminal else subprocess.DEVNULL,
                start_new_session=True,
            )
        if in_terminal:
            os.close(screen)
            os.set_blocking(self.terminal, False)
        os.set_blocking(self.serial, False)

    def place(self, protocol: str) -> Path:
        """The path of a pseudo-terminal or of a file."""
        return self.folder / protocol

    def _link(self, words: Words, line: str) -> dict[str, Any]:
        port = self.ports[words.protocol]
        places = {"serial": line, "pty": str(self.place(words.protocol)), "file": str(self.place(words.protocol))}
        link = {"protocol": words.protocol, words.place: places.get(words.place, f"127.0.0.1:{port}"), **words.keys}
        return link | ({"status_to": f"127.0.0.1:{port + ANSWERS_ABOVE}"} if words.protocol == "n1mm" else {})

    async def answers(self) -> None:
        """Wait until the box runs. Raises SystemExit: it does not."""
        give_up_s = time.monotonic() + 3 * PATIENCE_S
        while time.monotonic() < give_up_s and self.process.poll() is None:
            with suppress(OSError):
                await self.says("status")
                await self.asked("seen")
                return
            await asyncio.sleep(0.2)
        raise SystemExit("the box does not start")

    async def asked(self, word: str) -> dict[str, Any]:
        """The probe's answer. Raises OSError, TimeoutError."""
        async with asyncio.timeout(PATIENCE_S):
            reader, writer = await asyncio.open_unix_connection(f"{self.folder}/probe", limit=1 << 26)
            try:
                writer.write(word.encode())
                answer: dict[str, Any] = json.loads(await reader.readline())
                return answer
            finally:
                writer.close()

    async def says(self, *lines: str) -> str:
        """The console's answers to these lines. Raises OSError, TimeoutError."""
        answers = ""
        async with asyncio.timeout(PATIENCE_S):
            reader, writer = await asyncio.open_unix_connection(f"{self.folder}/console")
            try:
                for line in lines:
                    writer.write(f"{line}\n".encode())
                    while not (answer := (await reader.readline()).decode()).startswith(("ok", "error")) and answer:
                        answers += answer
                    answers += answer
            finally:
                writer.close()
        return answers

    @property
    def cpu_s(self) -> float:
        """Seconds of a core, with those of what it has computed in processes of its own."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return sum(map(int, fields[11:15])) / TICKS_PER_S

    @property
    def private_kib(self) -> int:
        """Memory that is the process's own: private pages, by the kernel's account."""
        rollup = Path(f"/proc/{self.process.pid}/smaps_rollup").read_text().splitlines()
        return sum(int(line.split()[1]) for line in rollup if line.startswith("Private_"))

    @property
    def files(self) -> int:
        """Open file descriptors."""
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))

    async def stop(self) -> int:
        """As the system ends it. Returns its exit code."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        code = await asyncio.to_thread(self.process.wait, PATIENCE_S)
        for fd in (self.serial, self.terminal):
            with suppress(OSError):
                os.close(fd)
        return code
