"""Boot the kernel under QEMU, run one command on the host's own files, and bring its exit status back.

Knows QEMU's command line and the initial file system. Does not know what the command is. Nothing the guest writes
stays: the host's files are shared read-only, and what is written over them is in the guest's memory.
"""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.kernel.stage.debian import StageError

INIT = Path(__file__).with_name("init.sh")
MEMORY = "1536M"
KERNEL_LINE = "console=ttyS0 quiet loglevel=3 panic=-1 cryptomgr.notests mitigations=off init=/init"
"""ACPI stays on, though a boot without it is a second faster: without its timers the kernel measures the processor's
counter against an emulated PIT, and its clock may run at three times the speed, or in steps of 4 ms."""
CLOCK = "shift=2,sleep=on"
"""The machine's clock counts instructions, 4 ns each, and goes on by itself only while the machine waits. So a busy
host makes a run longer, and no test late: the box inside sees a processor of one speed."""
DYNAMIC_LINKER = b"/lib64/ld-linux"
"""Stands at the beginning of a program that cannot run alone."""
READY = b"== the kernel is up\r\n"
NO_VERDICT = 125
"""The guest ended without a status: a panic, or the time was over."""


@dataclass(frozen=True, slots=True)
class Outcome:
    status: int
    boot_s: float
    command_s: float


def boot(kernel: Path, command: Sequence[str], folder: Path, settings: Mapping[str, str], patience_s: float) -> Outcome:
    """Run `command` in `folder` with those environment variables; what it says goes to our standard output."""
    with tempfile.TemporaryDirectory(prefix="kernel-stage-") as scratch:
        initial = _initial_files(kernel, Path(scratch), command, folder, settings)
        return _run(kernel, initial, patience_s)


def _run(kernel: Path, initial: Path, patience_s: float) -> Outcome:
    share = "local,id=host,path=/,security_model=none,readonly=on,multidevs=remap"
    started_s = time.monotonic()
    machine = subprocess.Popen(
        [
            *("qemu-system-x86_64", "-accel", "tcg", "-M", "pc", "-cpu", "max", "-m", MEMORY),
            *("-icount", CLOCK),
            *("-nodefaults", "-display", "none", "-serial", "stdio", "-no-reboot"),
            *("-device", "isa-debug-exit,iobase=0xf4,iosize=4"),
            *("-fsdev", share, "-device", "virtio-9p-pci,fsdev=host,mount_tag=host"),
            *("-kernel", str(kernel / "vmlinux"), "-initrd", str(initial), "-append", KERNEL_LINE),
        ],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
    )
    overdue = threading.Timer(patience_s, machine.kill)
    overdue.start()
    up_s = None
    try:
        assert machine.stdout is not None
        beginning: bytes | None = b""
        while chunk := os.read(machine.stdout.fileno(), 65536):
            if beginning is not None:
                beginning += chunk
                _, ready, chunk = beginning.partition(READY)
                if not ready:
                    continue
                up_s = time.monotonic()
                beginning = None
            sys.stdout.write(chunk.decode(errors="replace").replace("\r", ""))
            sys.stdout.flush()
        code = machine.wait()
    finally:
        overdue.cancel()
        machine.kill()
        machine.wait()
    ended_s = time.monotonic()
    if up_s is None:
        last_words = (beginning or b"").decode(errors="replace")[-2000:]
        raise StageError(f"the kernel did not come up; its last words:\n{last_words}")
    # isa-debug-exit ends QEMU with twice the value plus one; without a verdict it ends even, or is killed.
    status = code >> 1 if code > 0 and code & 1 else NO_VERDICT
    return Outcome(status, up_s - started_s, ended_s - up_s)


def _initial_files(
    kernel: Path, scratch: Path, command: Sequence[str], folder: Path, settings: Mapping[str, str]
) -> Path:
    """A file system in one archive: busybox, the modules, our init, and the command as a script."""
    root = scratch / "root"
    (root / "bin").mkdir(parents=True)
    busybox = Path(shutil.which("busybox") or "")
    if DYNAMIC_LINKER in busybox.read_bytes()[:4096]:
        raise StageError("busybox needs shared libraries: sudo apt install busybox-static")
    shutil.copy(busybox, root / "bin/busybox")
    shutil.copytree(kernel / "modules", root / "modules")
    shutil.copy(INIT, root / "init")
    (root / "init").chmod(0o755)
    lines = ["#!/bin/sh", *(f"export {name}={shlex.quote(value)}" for name, value in settings.items())]
    lines += [f"cd {shlex.quote(str(folder))} || exit 1", f"exec {shlex.join(command)}"]
    (root / "command").write_text("\n".join(lines) + "\n")
    archive = scratch / "initial.cpio"
    names = sorted(str(path.relative_to(root)) for path in root.rglob("*"))
    with archive.open("wb") as out:
        done = subprocess.run(
            ["cpio", "--quiet", "-o", "-H", "newc", "-R", "0:0"],
            input="\n".join(names).encode(),
            stdout=out,
            cwd=root,
            check=False,
        )
    if done.returncode:
        raise StageError(f"cpio ended with {done.returncode}: is the disk full?")
    return archive
