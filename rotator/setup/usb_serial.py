"""Plans the set-up that makes the Pi a COM port of the PC: a line of config.txt, a systemd unit, and a `[[link]]`.

Knows the overlay, the unit, the lines of that link (one that the user has changed stays), and other programs that use
the same USB controller. `gadget` builds the USB device. Works on texts and writes no file.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from rotator.config.load import ConfigError, parse
from rotator.setup import boot_config
from rotator.setup.blocks import Block
from rotator.setup.pi import Pi
from rotator.setup.plan import ChangeSet, Content, Files, Link, SetupError, planned

OVERLAY = "dtoverlay=dwc2,dr_mode=peripheral"
BLOCK = Block("rotator setup usb-serial", re.compile(r"\[all\]|" + re.escape(OVERLAY)))

NAME = "rotator-usb-serial"
UNITS = Path("etc/systemd/system")
UNIT = UNITS / f"{NAME}.service"
WANTED = UNITS / f"multi-user.target.wants/{NAME}.service"
GETTYS = tuple(UNITS / f"{getty}@ttyGS0.service.d/{NAME}.conf" for getty in ("serial-getty", "getty"))
MODULES = ("etc/modules", *(f"{place}/modules-load.d/*.conf" for place in ("etc", "usr/lib", "usr/local/lib")))

RPI_USB_GADGET = "usr/lib/modules-load.d/usb-gadget.conf"
_LEGACY_GADGET = re.compile(r"g_[a-z_]+")

_NO_GETTY = f"""\
# The box speaks on this port: no login there. Removed by `rotator setup usb-serial --undo`.
[Unit]
ConditionPathExists=!/{UNIT}
"""

PORT = "/dev/ttyGS0"
LINK_LINES = ("[[link]]                      # the PC, over USB", 'protocol = "gs232b"', f'serial = "{PORT}"')
LINK_BLOCK = Block("rotator setup usb-serial", re.compile("|".join(map(re.escape, LINK_LINES))), last=True)

_BY_HAND = 'add a [[link]] with protocol = "gs232b" and serial = "/dev/ttyGS0" to your rotator.toml'

TWO_ADAPTERS = """\
Without it the Pi and the PC still meet over two USB serial adapters (3.3 V or RS-232, both of one kind):
  one in the Pi, one in the PC, TX of each to RX of the other, GND to GND, nothing else.
  In rotator.toml: a [[link]] with serial = "/dev/ttyUSB0" and the protocol of your program.
`rotator help usb-serial` has the details."""


@dataclass(frozen=True, slots=True)
class Places:
    """The paths of the files that this set-up reads."""

    root: Path
    boot_config: Path
    settings: Path
    """rotator.toml"""

    @property
    def command_line(self) -> Path:
        return self.boot_config.with_name("cmdline.txt")

    def planned(
        self, files: Files, boot: str, ours: Mapping[Path, Content], settings: Content, notes: Iterable[str]
    ) -> ChangeSet:
        """The changes of these files. `ours`: the files of this set-up, by their path below the root."""
        wanted = {self.boot_config: boot, **{self.root / path: content for path, content in ours.items()}}
        return planned(files, wanted | {self.settings: settings}, (self.boot_config, self.settings), notes)


def unit(command: str, usb_id: str) -> str:
    """The text of the systemd unit. `command` starts `rotator`, quoted for systemd."""
    return f"""\
[Unit]
Description=The Pi's USB port as a serial port of the PC
Requires=sys-kernel-config.mount
After=sys-kernel-config.mount systemd-modules-load.service
StartLimitIntervalSec=120
StartLimitBurst=20

[Service]
Type=oneshot
RemainAfterExit=yes
ExecStartPre=/sbin/modprobe libcomposite
ExecStart={command} setup usb-serial --up --usb-id {usb_id}
ExecStop={command} setup usb-serial --down
# The controller may appear later than this unit starts.
Restart=on-failure
RestartSec=2

[Install]
WantedBy=multi-user.target
"""


def plan(files: Files, places: Places, pi: Pi | None, *, command: str, usb_id: str) -> ChangeSet:
    """The changes and notes. Raises SetupError if this Pi cannot be a USB device, or another program has the port."""
    if pi is None:
        raise SetupError("this is no Raspberry Pi that the program knows: only those can become a COM port this way")
    if pi.socket is None:
        raise SetupError(f"a {pi.model} has no socket that can be a USB device: nothing was changed.\n{TWO_ADAPTERS}")
    if rival := _rival(files, places):
        raise SetupError(rival)
    before = _text(files, places.boot_config)
    settings, remark = _link_added(_text(files, places.settings) if files[places.settings] is not None else None)
    ours: dict[Path, Content] = {UNIT: unit(command, usb_id), WANTED: Link(f"/{UNIT}")}
    ours |= dict.fromkeys(GETTYS, _NO_GETTY)
    notes = [
        f"The port is {pi.socket} of this {pi.model}. {pi.power}",
        "Afterwards no keyboard, network adapter or stick works at that socket.",
    ]
    if remark:
        notes.append(f"{places.settings}: {remark}")
    return places.planned(files, boot_text(before, pi), ours, settings, notes)


def undone(files: Files, places: Places) -> ChangeSet:
    """The changes that remove the lines and files of `plan`, and no others."""
    text = _text(files, places.settings) if files[places.settings] is not None else None
    settings, remark = _link_taken_out(text)
    ours: dict[Path, Content] = dict.fromkeys((WANTED, UNIT, *GETTYS))
    notes = [f"{places.settings}: {remark}"] if remark else []
    return places.planned(files, BLOCK.without(_text(files, places.boot_config)), ours, settings, notes)


def boot_text(text: str, pi: Pi) -> str:
    """config.txt with the controller in device mode. Raises SetupError if another line makes it a host."""
    others = [each for each in boot_config.settings(BLOCK.without(text)) if each.may_hold_on(pi)]
    for setting in others:
        if setting.key == "otg_mode" and setting.value not in boot_config.NO:
            raise _says_host(setting)
    # dwc-otg is the older driver of the same controller, and can only be a host.
    for setting, _ in boot_config.overlays(others, "dwc-otg"):
        raise _says_host(setting)
    enough = False
    for setting, options in boot_config.overlays(others, "dwc2"):
        if options.get("dr_mode") == "host":
            raise _says_host(setting)
        # Without dr_mode, or with otg, the port is a device unless a plugged-in adapter makes it a host.
        enough = enough or not setting.filters
    return BLOCK.into(text, [] if enough else ["[all]", OVERLAY])


def _says_host(setting: boot_config.Setting) -> SetupError:
    return SetupError(
        f"config.txt makes the port a host ({setting}): if no USB device of yours hangs on it, "
        "put a # before that line and run this again"
    )


def _rival(files: Files, places: Places) -> str | None:
    """An error text if another program takes the USB controller at each start: it can have only one device."""
    if files.get(places.root / RPI_USB_GADGET) is not None:
        return (
            "Raspberry Pi's own USB gadget (Ethernet) has the port, and there is only one: "
            "switch it off with `sudo rpi-usb-gadget off`, then run this again"
        )
    for path, content in files.items():
        if isinstance(content, str) and any(path.match(f"{places.root}/{each}") for each in MODULES):
            for line in content.splitlines():
                if _LEGACY_GADGET.fullmatch(line.strip().split(" ")[0]):
                    return _taken(path, line.strip())
    for word in _text(files, places.command_line).split():
        if word.startswith("modules-load=") and (found := _LEGACY_GADGET.search(word)):
            return _taken(places.command_line, found[0])
        if word == "console=ttyGS0" or word.startswith("console=ttyGS0,"):
            return f"{places.command_line} puts a console on this port: take {word} out of it, then run this again"
    return None


def _taken(path: Path, module: str) -> str:
    return f"{path} loads {module}, which takes the port, and there is only one: take it out, then run this again"


def _text(files: Files, path: Path) -> str:
    content = files.get(path)
    return content if isinstance(content, str) else ""


def _link_added(text: str | None) -> tuple[str | None, str]:
    """The text with a link on the port, and a note for the user if the link cannot be added."""
    if text is None:
        return None, f"there is no such file; {_BY_HAND}"
    try:
        if any(link.serial == PORT for link in parse(text, "rotator.toml").link):
            return text, ""
        longer = LINK_BLOCK.into(text, LINK_LINES)
        parse(longer, "rotator.toml")
    except (ConfigError, SetupError):
        return text, f"it stays unchanged, because it has a fault or its marks are damaged; {_BY_HAND}"
    return longer, ""


def _link_taken_out(text: str | None) -> tuple[str | None, str]:
    """The text without the link, and a note if the link stays."""
    if text is None:
        return None, ""
    if LINK_BLOCK.strangers(text):
        return text, "its link on /dev/ttyGS0 has been changed since, so it stays; without the port it only waits"
    try:
        shorter = LINK_BLOCK.without(text)
        if shorter != text:
            parse(shorter, "rotator.toml")
    except (ConfigError, SetupError):
        return text, "its link on /dev/ttyGS0 stays: without it the file could not be read"
    return shorter, ""
