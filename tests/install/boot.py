"""A Debian root that runs: systemd as its first process, in a container on this machine's kernel.

Knows how to boot one in an overlay that is thrown away, and to run a command in it. What `roots` only enters, this
starts: units run, stop and fail as on a Pi.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from tests.install.roots import PRIVATE, Layer, Said, said

NOT_IN_A_CONTAINER = ("systemd-networkd", "systemd-resolved", "systemd-timesyncd")
"""Services that would touch this machine's network."""


class Booted:
    """`lowers`: the layers below, the topmost first. `gifts`: files that it finds in /root."""

    def __init__(self, lowers: list[Path], layer: Layer, gifts: list[Path]) -> None:
        for name in ("upper/root", "work", "merged"):
            (layer.folder / name).mkdir(parents=True)
        for gift in gifts:
            shutil.copy(gift, layer.upper / "root")
        merged = layer.folder / "merged"
        options = f"lowerdir={':'.join(map(str, lowers))},upperdir={layer.upper},workdir={layer.folder / 'work'}"
        masked = " ".join(f"systemd.mask={unit}.service" for unit in NOT_IN_A_CONTAINER)
        script = f"""
            mount -t overlay overlay -o '{options}' '{merged}'
            exec systemd-nspawn --quiet --directory='{merged}' --private-network --register=no --keep-unit \
                --machine=rotator-{layer.folder.name} --console=pipe --boot {masked}
        """
        self._log = (layer.folder / "console").open("wb")
        self._container = subprocess.Popen(
            [*PRIVATE, "sh", "-ec", script], stdin=subprocess.DEVNULL, stdout=self._log, stderr=subprocess.STDOUT
        )
        self._first = self._first_process(layer.folder / "console")
        assert self.run("systemctl", "is-system-running", "--wait").text.strip() in ("running", "degraded")

    def _first_process(self, console: Path) -> int:
        """systemd's process id, as this machine sees it, once it listens."""
        while self._container.poll() is None:
            said = subprocess.run(
                ["pgrep", "-P", str(self._container.pid)], capture_output=True, text=True, check=False
            )
            if said.stdout.strip():
                first = int(said.stdout.split()[0])
                if Path(f"/proc/{first}/root/run/systemd/private").exists():
                    return first
        raise AssertionError(f"it does not boot: {console.read_text()[-2000:]}")

    def __enter__(self) -> Booted:
        return self

    def __exit__(self, *_: object) -> None:
        # nspawn ends its container when it is told to end; the mounts go with the processes.
        self.run("systemctl", "poweroff", "--force", "--force")
        self._container.wait(60)
        self._log.close()

    def at(self, path: str) -> Path:
        return Path(f"/proc/{self._first}/root") / path.lstrip("/")

    def run(self, *command: str, **environment: str) -> Said:
        """In the container, as its root."""
        return said(["nsenter", "--target", str(self._first), "--all", "--wd", "--root", *command], environment)
