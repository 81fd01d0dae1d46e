"""`rotator setup`: shows the planned changes to this Pi, asks, makes them, and says that a reboot is due.

Knows the dialogue, the paths of the settings, and the identity of the USB device. `rotator.setup` plans the changes,
and its `tree` writes the files.
"""

from __future__ import annotations

import hashlib
import re
import sys
from collections.abc import Callable
from contextlib import suppress
from datetime import date
from pathlib import Path

import click

from rotator.cli.lines import say
from rotator.config.load import load
from rotator.setup import gadget, pins, tree, usb_serial
from rotator.setup.pi import SHORT_NAMES, Pi, known
from rotator.setup.plan import ChangeSet, SetupError, diff

SETTINGS = Path("etc/rotator/rotator.toml")
INSTALLED = Path("opt/rotator/current/bin/rotator")

CONFIGFS, CONTROLLERS = Path("sys/kernel/config"), Path("sys/class/udc")
SERIALS = (Path("proc/device-tree/serial-number"), Path("sys/firmware/devicetree/base/serial-number"))


def usb_serial_port(
    root: Path, settings: Path | None, *, undo: bool, yes: bool, usb_id: str, model: str | None, device: str | None
) -> None:
    """`device`: build (`up`) or remove (`down`) the USB device now, and change no file."""
    if device == "up":
        controller = gadget.up(root / CONFIGFS, root / CONTROLLERS, identity(_serial_number(root), usb_id))
        return click.echo(f"USB serial port on {controller}")
    if device == "down":
        return gadget.down(root / CONFIGFS)
    identity("", usb_id)
    boot = tree.boot_config(root)
    places = usb_serial.Places(root, boot, settings or root / SETTINGS)
    ours = [root / path for path in (usb_serial.UNIT, usb_serial.WANTED, *usb_serial.GETTYS)]
    theirs = [boot, places.command_line, places.settings, root / usb_serial.RPI_USB_GADGET]
    files = tree.read(*ours, *theirs, *tree.matching(root, usb_serial.MODULES))
    _refuse_overlay(str(files[places.command_line] or ""))
    if undo:
        propose(usb_serial.undone(files, places), yes=yes, done=_then(root))
    else:
        plan = usb_serial.plan(files, places, _pi(root, model, yes=yes), command=_command(root), usb_id=usb_id)
        propose(plan, yes=yes, done=_then(root))
    return None


def relay_pins(root: Path, settings: Path | None, *, undo: bool, yes: bool) -> None:
    boot = tree.boot_config(root)
    command_line = boot.with_name("cmdline.txt")
    files = tree.read(boot, command_line, root / pins.I2C_MODULE)
    _refuse_overlay(str(files[command_line] or ""))
    if undo:
        propose(pins.undone(files, root, boot), yes=yes, done=_then(root))
    else:
        path = settings or root / SETTINGS
        if not path.exists():
            raise SetupError(f"there is no {path}: say with --config which file names your relay pins")
        propose(pins.plan(files, root, boot, load(path), tree.pi(root)), yes=yes, done=_then(root))


def _pi(root: Path, model: str | None, *, yes: bool) -> Pi | None:
    """The Pi of these files: this one; for a card in another computer the one that `model` or the person names."""
    if model is None and (here := tree.pi(root)):
        return here
    if model is None and not tree.is_card(root):
        return None
    names = list(SHORT_NAMES)
    if model is None and yes:
        raise SetupError(f"say which Pi takes this card: --pi NAME, one of {', '.join(names)}")
    if model is None:
        click.echo("Which Pi takes this card?")
        for number, name in enumerate(names, 1):
            click.echo(f"{number:>4}  {SHORT_NAMES[name]}")
        try:
            model = names[click.prompt("Number", type=click.IntRange(1, len(names))) - 1]
        except click.Abort:
            raise SetupError(f"nothing was changed (--pi NAME says it: one of {', '.join(names)})") from None
    short = model.lower().replace(" ", "")
    full = SHORT_NAMES.get(short) or SHORT_NAMES.get(f"{short}b")
    if full is None:
        raise SetupError(f"--pi {model}: no such Pi; there are {', '.join(names)}")
    return known(f"Raspberry Pi {full}")


def identity(serial: str, usb_id: str) -> gadget.Identity:
    """The identity from `1d6b:0104`: vendor and product. Raises SetupError."""
    parts = re.fullmatch(r"([0-9a-fA-F]{4}):([0-9a-fA-F]{4})", usb_id)
    if not parts:
        raise SetupError(f'--usb-id {usb_id}: must be vendor and product in hexadecimal, such as "1d6b:0104"')
    return gadget.Identity(serial, int(parts[1], 16), int(parts[2], 16))


def _serial_number(root: Path) -> str:
    """The serial number of the Pi; on another computer a number made from its machine id."""
    for path in SERIALS:
        with suppress(OSError):
            return (root / path).read_text().rstrip("\0\n")
    with suppress(OSError):
        # The machine id itself must not be published: see machine-id(5).
        machine = (root / "etc/machine-id").read_bytes().strip()
        return hashlib.sha256(b"gs232-rotator usb" + machine).hexdigest()[:16]
    return "0"


def _command(root: Path) -> str:
    """The command line of this program for systemd: the installed program, else the one that runs now."""
    if (root / INSTALLED).exists() or root.resolve() != Path("/"):
        return f"/{INSTALLED}"
    started = Path(sys.argv[0]).absolute()
    words = [sys.executable, "-m", "rotator"] if started.name == "__main__.py" else [str(started)]
    return " ".join(_quoted(word) for word in words)


def _quoted(word: str) -> str:
    word = word.replace("%", "%%").replace("$", "$$")
    return word if re.fullmatch(r"[\w/.%$+-]+", word) else '"' + word.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _refuse_overlay(command_line: str) -> None:
    if any(word.startswith(tree.OVERLAYS) for word in command_line.split()):
        raise SetupError(
            "the overlay file system is on, and a reboot would undo the changes: "
            "switch it off in raspi-config (Performance), reboot, run this, and switch it on again"
        )


def propose(plan: ChangeSet, *, yes: bool, done: str, today: Callable[[], date] = date.today) -> bool:
    """Show the changes, ask, and make them, all or none. `done` is said then. Returns whether there were any."""
    for note in plan.notes:
        say(note)
    if not plan.changes:
        click.echo("Nothing to change: everything is as it should be.")
        return False
    for change in plan.changes:
        for line in diff(change):
            click.echo(line.encode("utf-8", "replace").decode())
    if reason := tree.hindrance(plan):
        raise SetupError(f"{reason}. Nothing was changed")
    if not yes:
        try:
            click.confirm("\nDo this?", abort=True)
        except click.Abort:
            raise SetupError("nothing was changed (--yes does it without asking)") from None
    for copy in tree.carry_out(plan, today()):
        click.echo(f"The file as it was: {copy}")
    say(done)
    return True


def _then(root: Path) -> str:
    """What makes a change of config.txt take effect."""
    if not tree.is_card(root):
        return "Done. It takes effect after a reboot: sudo reboot"
    done = "Done. It takes effect when the Pi starts from this card."
    installed = (root / INSTALLED).is_symlink() or (root / INSTALLED).exists()
    return done if installed else f"{done}\nThe program is not on this card yet: run sudo ./install.sh on the Pi."
