"""`rotator setup usb-serial` on cards of every kind: what it adds, what it refuses, what it takes out again."""

from __future__ import annotations

import shutil
import subprocess
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.setup.pi import known
from rotator.setup.usb_serial import boot_text, unit
from tests.setup.conftest import BOOKWORM, Card

ADDED = """\
# rotator setup usb-serial: begin
[all]
dtoverlay=dwc2,dr_mode=peripheral
# rotator setup usb-serial: end
"""
UNIT = "etc/systemd/system/rotator-usb-serial.service"
PI_4 = known("Raspberry Pi 4 Model B Rev 1.4")


def test_the_overlay_the_unit_and_the_link(shipped: Card) -> None:
    before = shipped.files()
    said = shipped.setup("usb-serial", "--yes")
    assert said.code == 0
    assert "USB-C socket" in said.text
    assert "takes effect when the Pi starts from this card" in said.text
    after = shipped.files()
    assert after["boot/firmware/config.txt"] == ADDED.encode() + before["boot/firmware/config.txt"]
    assert after["etc/systemd/system/multi-user.target.wants/rotator-usb-serial.service"] == f"/{UNIT}"
    unit = after[UNIT].decode()
    assert "ExecStart=/opt/rotator/current/bin/rotator setup usb-serial --up --usb-id 1d6b:0104\n" in unit
    assert "RemainAfterExit=yes\n" in unit
    for getty in ("serial-getty", "getty"):
        drop_in = after[f"etc/systemd/system/{getty}@ttyGS0.service.d/rotator-usb-serial.conf"]
        assert f"ConditionPathExists=!/{UNIT}\n".encode() in drop_in
    toml = after["etc/rotator/rotator.toml"].decode()
    assert toml.startswith(before["etc/rotator/rotator.toml"].decode())
    assert tomllib.loads(toml)["link"][1] == {"protocol": "gs232b", "serial": "/dev/ttyGS0"}


def test_a_link_that_the_person_has_changed_since_stays(card: Card) -> None:
    card.setup("usb-serial", "--yes")
    card.rotator.write_text(card.rotator.read_text().replace("gs232b", "gs232a"))
    changed = card.rotator.read_text()
    said = card.setup("usb-serial", "--undo", "--yes")
    assert "has been changed since" in said.text
    assert card.rotator.read_text() == changed


@given(data=st.data())
def test_other_peoples_lines_decide_nothing_unless_they_speak_of_the_port(data: st.DataObject) -> None:
    assert PI_4 is not None
    lines = st.sampled_from(
        ["[cm4]", "[all]", "otg_mode=1 ", "#otg_mode=1", "dtoverlay=vc4-kms-v3d", "dtparam=audio=on"]
    )
    text = "\n".join(["[cm4]", *data.draw(st.lists(lines.filter(lambda line: line != "[all]")))])
    assert boot_text(text, PI_4) == ADDED + text


@pytest.mark.parametrize(
    ("lines", "added"),
    [
        ("dtoverlay=dwc2", ""),
        ("dtoverlay=dwc2,dr_mode=otg", ""),
        ("dtoverlay=dwc2,dr_mode=peripheral", ""),
        ("[pi5]\ndtoverlay=dwc2", ADDED),
        ("[pi4]\ndtoverlay=dwc2", ADDED),
        ("[EDID=BNQ-BenQ]\ndtoverlay=dwc2", ADDED),
    ],
)
def test_a_line_that_does_it_already_is_enough_unless_it_has_a_condition(card: Card, lines: str, added: str) -> None:
    card.boot.write_text(f"{BOOKWORM}{lines}\n")
    assert card.setup("usb-serial", "--yes").code == 0
    assert card.boot.read_text() == f"{added}{BOOKWORM}{lines}\n"


@pytest.mark.parametrize("line", ["otg_mode=1", "dtoverlay=dwc2,dr_mode=host", "dtoverlay=dwc-otg"])
def test_a_host_port_is_left_to_the_person(card: Card, line: str) -> None:
    card.boot.write_text(f"{BOOKWORM}{line}\n")
    before = card.files()
    said = card.setup("usb-serial", "--yes")
    assert said.code == 1
    assert f"makes the port a host (line 24, {line})" in said.text
    assert "put a # before that line" in said.text
    assert card.files() == before


@pytest.mark.parametrize(
    "model",
    ["Model B Rev 2", "2 Model B Rev 1.1", "3 Model B Rev 1.2", "3 Model B Plus Rev 1.3"],
)
def test_a_pi_with_a_hub_cannot_and_is_told_the_other_way(card: Card, model: str) -> None:
    card.is_a(f"Raspberry Pi {model}")
    before = card.files()
    said = card.setup("usb-serial", "--yes")
    assert said.code == 1
    assert "no socket that can be a USB device" in said.text
    assert "two USB serial adapters" in said.text
    assert "TX of each to RX of the other" in said.text
    assert 'serial = "/dev/ttyUSB0"' in said.text
    assert card.files() == before


# --- a card in another computer


@pytest.fixture
def elsewhere(card: Card) -> Card:
    """A card as it is mounted on a PC: its /proc is an empty folder."""
    (card.root / "proc/device-tree/model").unlink()
    (card.root / "proc/device-tree").rmdir()
    return card


def test_on_a_card_the_person_says_which_pi_takes_it(elsewhere: Card) -> None:
    said = elsewhere.setup("usb-serial", "--pi", "zero2w", "--yes")
    assert said.code == 0, said.text
    assert "micro-USB socket marked USB of this Raspberry Pi Zero 2 W" in said.text
    assert "when the Pi starts from this card" in said.text
    assert "run sudo ./install.sh on the Pi" in said.text
    assert elsewhere.boot.read_text() == ADDED + BOOKWORM
    assert elsewhere.setup("usb-serial", "--undo", "--yes").code == 0
    assert elsewhere.boot.read_text() == BOOKWORM


def test_or_is_asked(elsewhere: Card) -> None:
    said = elsewhere.setup("usb-serial", "--usb-id", "1209:0001", answer="1\ny\n")
    assert "Which Pi takes this card?\n   1  Zero 2 W\n" in said.text
    assert said.code == 0
    assert "--up --usb-id 1209:0001\n" in (elsewhere.root / UNIT).read_text()
    assert elsewhere.boot.read_text() == ADDED + BOOKWORM


@pytest.mark.parametrize(
    ("words", "advice"),
    [
        (("--yes",), "say which Pi takes this card: --pi NAME, one of zero2w, "),
        (("--yes", "--pi", "9z"), "--pi 9z: no such Pi; there are zero2w, "),
        (("--yes", "--pi", "3b+"), "no socket that can be a USB device"),
    ],
)
def test_without_a_pi_that_can_nothing_is_changed(elsewhere: Card, words: tuple[str, ...], advice: str) -> None:
    before = elsewhere.files()
    said = elsewhere.setup("usb-serial", *words)
    assert said.code == 1
    assert advice in said.text
    assert elsewhere.files() == before


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ("../bootfs/config.txt", ""),  # beside it, as a desktop mounts both
        ("away", "sudo mount /dev/sdX1 {root}/boot/firmware"),
        ("config.txt", "is the card's boot partition"),
    ],
)
def test_where_the_boot_partition_may_be(elsewhere: Card, place: str, said: str) -> None:
    moved = elsewhere.root / place
    moved.parent.mkdir(exist_ok=True)
    elsewhere.boot.rename(moved)
    done = elsewhere.setup("usb-serial", "--pi", "5", "--yes")
    assert done.code == bool(said)
    assert said.format(root=elsewhere.root) in done.text
    assert moved.read_text() == ("" if said else ADDED) + BOOKWORM


def test_a_folder_that_is_no_card(card: Card) -> None:
    card.boot.unlink()
    shutil.rmtree(card.root / "etc")
    assert "is this a Raspberry Pi's SD card?" in card.setup("usb-serial", "--yes").text


# --- other programs on the port


@pytest.mark.parametrize(
    ("path", "text", "advice"),
    [
        ("usr/lib/modules-load.d/usb-gadget.conf", "g_ether\n", "rpi-usb-gadget off"),
        ("etc/modules", "i2c-dev\ng_serial\n", "etc/modules loads g_serial"),
        ("etc/modules-load.d/usb.conf", "# mine\ng_multi use_eem=0\n", "usb.conf loads g_multi"),
        ("boot/firmware/cmdline.txt", "root=/dev/sda1 modules-load=dwc2,g_ether quiet\n", "cmdline.txt loads g_ether"),
        ("boot/firmware/cmdline.txt", "console=ttyGS0,115200 root=/dev/sda1\n", "take console=ttyGS0,115200 out"),
        ("boot/firmware/cmdline.txt", "overlayroot=tmpfs root=/dev/sda1\n", "switch it off in raspi-config"),
    ],
)
def test_whatever_has_the_port_is_named(card: Card, path: str, text: str, advice: str) -> None:
    card.write(path, text)
    before = card.files()
    said = card.setup("usb-serial", "--yes")
    assert said.code == 1
    assert advice in said.text
    assert card.files() == before


def test_modules_that_are_no_gadget(card: Card) -> None:
    card.write("etc/modules", "i2c-dev\n#g_ether\ndwc2\n")
    card.write("boot/firmware/cmdline.txt", "console=serial0,115200 modules-load=dwc2 root=/dev/sda1\n")
    assert card.setup("usb-serial", "--yes").code == 0


def test_the_newer_place_goes_before_the_older(card: Card) -> None:
    stub = card.write("boot/config.txt", "DO NOT EDIT THIS FILE\n")
    card.setup("usb-serial", "--yes")
    assert card.boot.read_text().startswith(ADDED)
    assert stub.read_text() == "DO NOT EDIT THIS FILE\n"


def test_a_link_that_is_there_stays_alone(card: Card) -> None:
    text = '[[link]]\nprotocol = "gs232-f1efw"\nserial = "/dev/ttyGS0"   # mine\n'
    card.rotator.write_text(text)
    card.setup("usb-serial", "--yes")
    assert card.rotator.read_text() == text


@pytest.mark.parametrize("text", [None, "[rotor\n", 'link = [{ protocol = "rotctld", tcp = "127.0.0.1:4533" }]\n'])
def test_a_rotator_toml_that_cannot_be_added_to(card: Card, text: str | None) -> None:
    card.rotator.unlink()
    if text is not None:
        card.rotator.write_text(text)
    said = card.setup("usb-serial", "--yes")
    assert said.code == 0
    assert 'add a [[link]] with protocol = "gs232b" and serial = "/dev/ttyGS0"' in said.text
    assert (card.rotator.read_text() if card.rotator.exists() else None) == text


@pytest.mark.parametrize("usb_id", ["1d6b", "1d6b:104", "x; reboot", ""])
def test_an_identity_that_is_none(card: Card, usb_id: str) -> None:
    said = card.setup("usb-serial", "--yes", "--usb-id", usb_id)
    assert (said.code, 'such as "1d6b:0104"' in said.text) == (1, True)


def test_systemd_finds_nothing_wrong(tmp_path: Path, need_program: Callable[[str, str], str]) -> None:
    verify = need_program("systemd-analyze", "systemd")
    path = tmp_path / "rotator-usb-serial.service"
    path.write_text(unit("/bin/true", "1d6b:0104"))
    done = subprocess.run([verify, "verify", str(path)], capture_output=True, text=True, timeout=60, check=False)
    ours = [line for line in done.stderr.splitlines() if "rotator-usb-serial" in line and "modprobe" not in line]
    assert ours == []
    assert done.returncode == 0 or "modprobe" in done.stderr
