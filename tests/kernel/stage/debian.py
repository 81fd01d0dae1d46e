"""Debian's own kernel and what it takes to add a module to it, all of one version.

Knows apt's names for them. Does not know what is built from them. Nothing is installed: packages are downloaded and
unpacked in a folder, so it works for every user.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

HEADERS_NEED = re.compile(r"linux-(headers-.*-common|kbuild-.*|compiler-.*)")
"""What a module's build takes of all that the headers depend on."""


class StageError(Exception):
    """The stage cannot be set up; the text says what to do."""


@dataclass(frozen=True, slots=True)
class KernelPackages:
    release: str
    """As `uname -r` says it: 6.1.0-56-amd64."""
    version: str
    """As dpkg says it: 6.1.192-2."""
    unpacked: tuple[str, ...]
    source: str


def current() -> KernelPackages:
    """The newest kernel that Debian installs today and has all the packages of. Raises StageError where apt knows none.

    Debian's archive publishes a security update in two halves, hours apart: the image, which it signs, waits for the
    other packages of its version or outlives them. Until both are there, the kernel before it is the newest.
    """
    for version in _versions("linux-image-amd64"):
        packages = _of(version)
        if all(version in _versions(name) for name in (*packages.unpacked, packages.source)):
            return packages
    raise StageError("apt knows no Debian kernel (linux-image-amd64): run apt-get update, on Debian for amd64")


def _of(version: str) -> KernelPackages:
    (image,) = (name for name in _depends(f"linux-image-amd64={version}") if name.startswith("linux-image-"))
    release = image.removeprefix("linux-image-")
    series = ".".join(version.split(".")[:2])
    headers = f"linux-headers-{release}"
    needs = [name for name in _depends(f"{headers}={version}") if HEADERS_NEED.fullmatch(name)]
    return KernelPackages(release, version, (image, headers, *needs), f"linux-source-{series}")


def download(packages: KernelPackages, folder: Path) -> None:
    names = [f"{name}={packages.version}" for name in (*packages.unpacked, packages.source)]
    # apt would download as the user _apt, who may not write here.
    user = ["-o", "APT::Sandbox::User=root"] if os.geteuid() == 0 else []
    run(["apt-get", "download", "-qq", *user, *names], folder)


def unpack(packages: KernelPackages, folder: Path, root: Path) -> None:
    for name in packages.unpacked:
        run(["dpkg-deb", "-x", str(_deb(folder, name)), str(root)], folder)


def unpack_source(packages: KernelPackages, folder: Path, files: Iterable[str]) -> None:
    """A few files of the kernel's source, without their folders, out of 1.3 GB."""
    archive = f"./usr/src/{packages.source}.tar.xz"
    members = " ".join(f"{packages.source}/{name}" for name in files)
    deb = _deb(folder, packages.source).name
    # tar leaves when it has what it came for; the programs before it then die of a broken pipe, as they should.
    script = (
        f"(dpkg-deb --fsys-tarfile {deb} | tar -xO {archive}) 2>/dev/null"
        f" | tar -xJ --occurrence=1 --transform 's,.*/,,' {members}"
    )
    run(["sh", "-c", script], folder)


def missing_tools(tools: dict[str, str]) -> list[str]:
    """The Debian packages of those programs (program -> package) that are not there."""
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    return sorted({package for program, package in tools.items() if shutil.which(program, path=path) is None})


def run(command: list[str], folder: Path) -> str:
    """What the command prints. Raises StageError with its last words."""
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    done = subprocess.run(
        command, cwd=folder, env=os.environ | {"PATH": path, "LC_ALL": "C"}, capture_output=True, text=True, check=False
    )
    if done.returncode:
        last = (done.stderr or done.stdout).strip().splitlines()[-5:]
        raise StageError(f"{' '.join(command[:3])} ended with {done.returncode}:\n  " + "\n  ".join(last))
    return done.stdout


def _deb(folder: Path, name: str) -> Path:
    return next(folder.glob(f"{name}_*.deb"))


def _depends(name: str) -> list[str]:
    return re.findall(r"Depends: (\S+)", _apt_cache("depends", name))


def _versions(name: str) -> list[str]:
    """What apt can download of the package, newest first."""
    return re.findall(r"^\s*\S+ \| +(\S+) \|", _apt_cache("madison", name), re.MULTILINE)


def _apt_cache(*words: str) -> str:
    return run(["apt-cache", *words], Path("/"))
