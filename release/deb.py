"""The Debian package: the program's folder, the unit, the udev rules and the scripts around them, by dpkg-deb.

Knows which file goes where on a Debian. The scripts themselves are in install/deb, the rest of the files in install/,
where install.sh takes them too.
"""

from __future__ import annotations

import gzip
import shutil
import tempfile
import time
from pathlib import Path

from release import environment, sbom
from release.source import Source, run, settle

HOME = "/usr/lib/gs232-rotator"
SCRIPTS = ("preinst", "postinst", "prerm", "postrm")
INSTALLER_HOME = "/opt/rotator/current"
"""Where install.sh has the program: the files in install/ say this."""


def build(source: Source, wheel: Path, into: Path, arch: str) -> tuple[Path, Path]:
    """The package for one architecture and the list of what is in it, in the folder `into`. Two builds of the same
    commit are the same to the byte."""
    version = deb_version(source)
    with tempfile.TemporaryDirectory() as scratch:
        root, around = Path(scratch, "root"), Path(scratch, "around")
        home, doc = root / HOME.lstrip("/"), root / "usr/share/doc/gs232-rotator"
        around.mkdir()
        environment.make(home, home=HOME, wheel=wheel, arch=arch, source=source, scratch=around)
        _put_system_files(source.folder / "install", root, arch)
        doc.mkdir(parents=True)
        listed = sbom.write(home, source, doc)
        _put_papers(source.folder, doc)
        _put_control(source.folder / "install/deb", root, version, arch)
        settle(root, source.epoch_s)
        made = into / f"gs232-rotator_{version}_{arch}.deb"
        # One thread: the cuts between several depend on the builder's machine. xz would take ten times as long.
        pack = ("dpkg-deb", "--root-owner-group", "--threads-max=1", "-Zzstd", "-z12", "--build")
        run(*pack, root, made, epoch_s=source.epoch_s)
        return made, Path(shutil.copyfile(listed, into / f"gs232-rotator_{version}_{arch}.cdx.json"))


def deb_version(source: Source) -> str:
    """0.1.0 for the release itself; later commits get their moment, so that apt takes the latest for the newest."""
    if source.is_tagged:
        return source.version
    return f"{source.version}+{time.strftime('%Y%m%d.%H%M%S', time.gmtime(source.epoch_s))}"


def _put_system_files(install: Path, root: Path, arch: str) -> None:
    lib, packages = root / "usr/lib", root / HOME.lstrip("/") / environment.PACKAGES
    unit = (install / "rotator.service").read_text(encoding="utf-8").replace(INSTALLER_HOME, HOME)
    for path, text in {
        "systemd/system/rotator.service": unit.replace("/lib/python3*/", "/lib/python3/"),
        "systemd/system.conf.d/50-rotator-watchdog.conf": (install / "50-rotator-watchdog.conf").read_text("utf-8"),
        "udev/rules.d/60-rotator.rules": (install / "60-rotator.rules").read_text("utf-8"),
        "sysusers.d/gs232-rotator.conf": (install / "deb/gs232-rotator.sysusers").read_text("utf-8"),
    }.items():
        (lib / path).parent.mkdir(parents=True)
        (lib / path).write_text(text, encoding="utf-8")
    shutil.copy(install / "first-config.sh", root / HOME.lstrip("/"))
    (root / "usr/bin").mkdir()
    (root / "usr/bin/rotator").symlink_to(f"../{HOME.removeprefix('/usr/')}/bin/rotator")
    # Debian's own spidev, where it is installed, for chips on the kernel's SPI. A link to nothing does no harm.
    for minor in environment.MINORS:
        module = f"spidev.cpython-3{minor}-{environment.MACHINES[arch]}-linux-gnu.so"
        (packages / module).symlink_to(f"/usr/lib/python3/dist-packages/{module}")


def _put_papers(folder: Path, doc: Path) -> None:
    packages = "gs232-rotator.cdx.json has the licence of each package in it, its .dist-info folder the text.\n"
    (doc / "copyright").write_text((folder / "LICENSE").read_text("utf-8") + "\n" + packages, encoding="utf-8")
    (doc / "changelog.gz").write_bytes(gzip.compress((folder / "CHANGELOG.md").read_bytes(), mtime=0))


def _put_control(scripts: Path, root: Path, version: str, arch: str) -> None:
    size_kb = sum(path.lstat().st_size for path in root.rglob("*") if path.is_file()) // 1024
    control = (scripts / "control").read_text("utf-8")
    for mark, value in {"@VERSION@": version, "@ARCH@": arch, "@SIZE_KB@": str(size_kb)}.items():
        control = control.replace(mark, value)
    debian = root / "DEBIAN"
    debian.mkdir()
    (debian / "control").write_text(control, encoding="utf-8")
    for name in (*SCRIPTS, "triggers"):
        shutil.copy(scripts / name, debian)
