"""A Raspberry Pi's card as files in a folder, and the command run on it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from rotator.cli.main import cli

BOOKWORM = """\
# For more options and information see
# http://rptl.io/configtxt
# Some settings may impact device functionality. See link above for details

# Uncomment some or all of these to enable the optional hardware interfaces
#dtparam=i2c_arm=on
#dtparam=i2s=on
#dtparam=spi=on

dtparam=audio=on
camera_auto_detect=1
display_auto_detect=1
auto_initramfs=1
dtoverlay=vc4-kms-v3d
max_framebuffers=2
arm_64bit=1
arm_boost=1

[cm4]
# Enable host mode on the 2711 built-in XHCI USB controller.
otg_mode=1

[all]
"""

TRIXIE = BOOKWORM.removesuffix("[all]\n") + "[cm5]\ndtoverlay=dwc2,dr_mode=host\n\n[all]\nenable_uart=1\n"

ROTATOR = """\
# My station.
[rotor]
hardware = "pi"

[[link]]
protocol = "rotctld"          # Gpredict
tcp = "127.0.0.1:4533"
"""


@dataclass(frozen=True)
class Answer:
    code: int
    text: str


class Card:
    """The root of a Pi's file system."""

    def __init__(self, root: Path) -> None:
        self.root = root
        for folder in (
            "boot/firmware",
            "proc/device-tree",
            "etc/rotator",
            "etc/systemd/system/multi-user.target.wants",
        ):
            (root / folder).mkdir(parents=True)
        self.boot = root / "boot/firmware/config.txt"
        self.rotator = root / "etc/rotator/rotator.toml"
        self.is_a("Raspberry Pi 4 Model B Rev 1.4")
        self.boot.write_text(BOOKWORM)
        self.rotator.write_text(ROTATOR)

    def is_a(self, model: str) -> None:
        self.write("proc/device-tree/model", model + "\0")

    def write(self, path: str, text: str) -> Path:
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_bytes(text.encode())
        return self.root / path

    def files(self) -> dict[str, Any]:
        """Everything on it but the copies that were kept, and but empty folders."""
        return {
            str(path.relative_to(self.root)): str(path.readlink()) if path.is_symlink() else path.read_bytes()
            for path in sorted(self.root.rglob("*"))
            if (path.is_symlink() or path.is_file()) and ".before-rotator-" not in path.name
        }

    def copies(self) -> list[Path]:
        return sorted(self.root.rglob("*.before-rotator-*"))

    def setup(self, *words: str, answer: str = "") -> Answer:
        """`rotator setup ...`; what main() makes a sentence of is the text."""
        result = CliRunner().invoke(cli, ["setup", *words, "--root", str(self.root)], input=answer)
        said = f"{result.exception}" if result.exception and not isinstance(result.exception, SystemExit) else ""
        return Answer(result.exit_code, result.output + said)


@pytest.fixture
def card(tmp_path: Path) -> Card:
    return Card(tmp_path / "card")


@pytest.fixture(params=[BOOKWORM, TRIXIE], ids=["bookworm", "trixie"])
def shipped(request: pytest.FixtureRequest, card: Card) -> Card:
    """A card as Raspberry Pi ships it, of either system."""
    card.boot.write_text(request.param)
    return card
