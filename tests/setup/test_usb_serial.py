"""`rotator setup usb-serial` on cards of every kind: what it adds, what it refuses, what it takes out again."""

from __future__ import annotations

import shutil
import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.setup.pi import SHORT_NAMES, known
from rotator.setup.usb_serial import BLOCK, boot_text
from tests.setup.conftest import BOOKWORM, Card
from tests.setup.test_blocks import ANY_FILE

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


def test_all_of_it_is_shown_first_and_no_is_the_default(card: Card) -> None:
    before = card.files()
    said = card.setup("usb-serial", answer="\n")
    assert said.code == 1
    assert f"+++ {card.boot}\n@@ -1,2 +1,6 @@\n+# rotator setup usb-serial: begin\n+[all]\n" in said.text
    assert f"+++ {card.root}/{UNIT}" in said.text
    assert '+serial = "/dev/ttyGS0"' in said.text
    assert "nothing was changed" in said.text
    assert card.files() == before
    assert card.copies() == []


def test_yes_at_the_question(card: Card) -> None:
    assert card.setup("usb-serial", answer="y\n").code == 0
    assert card.boot.read_text() == ADDED + BOOKWORM


def test_a_second_run_changes_nothing_and_says_so(card: Card) -> None:
    card.setup("usb-serial", "--yes")
    before = card.files()
    said = card.setup("usb-serial")
    assert said.code == 0
    assert "Nothing to change" in said.text
    assert card.files() == before


def test_a_copy_of_what_is_a_persons_own_is_kept(card: Card) -> None:
    card.setup("usb-serial", "--yes")
    card.setup("usb-serial", "--undo", "--yes")
    names = [path.name for path in card.copies()]
    config, again, toml, _ = names
    assert config.startswith("config.txt.before-rotator-20")
    assert again == f"{config}-2"
    assert toml.startswith("rotator.toml.before-rotator-20")
    assert (card.boot.parent / config).read_text() == BOOKWORM
    assert (card.boot.parent / again).read_text() == ADDED + BOOKWORM


def test_undo_leaves_the_card_as_it_was(shipped: Card) -> None:
    before = shipped.files()
    shipped.setup("usb-serial", "--yes")
    said = shipped.setup("usb-serial", "--undo", "--yes")
    assert said.code == 0
    assert "-dtoverlay=dwc2,dr_mode=peripheral" in said.text
    assert shipped.files() == before
    assert list(shipped.root.glob("etc/systemd/system/*.d")) == []
    assert "Nothing to change" in shipped.setup("usb-serial", "--undo").text


def test_undo_leaves_what_the_person_has_changed_since(card: Card) -> None:
    card.setup("usb-serial", "--yes")
    card.boot.write_text("dtparam=spi=on\n" + card.boot.read_text() + "hdmi_force_hotplug=1\n")
    card.setup("usb-serial", "--undo", "--yes")
    assert card.boot.read_text() == "dtparam=spi=on\n" + BOOKWORM + "hdmi_force_hotplug=1\n"


def test_a_link_that_the_person_has_changed_since_stays(card: Card) -> None:
    card.setup("usb-serial", "--yes")
    card.rotator.write_text(card.rotator.read_text().replace("gs232b", "gs232a"))
    changed = card.rotator.read_text()
    said = card.setup("usb-serial", "--undo", "--yes")
    assert "has been changed since" in said.text
    assert card.rotator.read_text() == changed


@given(text=ANY_FILE)
def test_any_config_txt_comes_back_byte_for_byte(text: str) -> None:
    assert PI_4 is not None
    assert BLOCK.without(boot_text(text, PI_4)) == text


@given(data=st.data())
def test_other_peoples_lines_decide_nothing_unless_they_speak_of_the_port(data: st.DataObject) -> None:
    assert PI_4 is not None
    lines = st.sampled_from(
        ["[cm4]", "[all]", "otg_mode=1 ", "#otg_mode=1", "dtoverlay=vc4-kms-v3d", "dtparam=audio=on"]
    )
    text = "\n".join(["[cm4]", *data.draw(st.lists(lines.filter(lambda line: line != "[all]")))])
    assert boot_text(text, PI_4) == ADDED + text


@pytest.mark.parametrize("line", ["dtoverlay=dwc2", "dtoverlay=dwc2,dr_mode=otg", "dtoverlay=dwc2,dr_mode=peripheral"])
def test_a_line_that_does_it_already_is_enough(card: Card, line: str) -> None:
    card.boot.write_text(f"{BOOKWORM}{line}\n")
    assert card.setup("usb-serial", "--yes").code == 0
    assert card.boot.read_text() == f"{BOOKWORM}{line}\n"


@pytest.mark.parametrize("section", ["[pi5]", "[pi4]", "[EDID=BNQ-BenQ]"])
def test_a_line_that_does_it_under_a_condition_is_not(card: Card, section: str) -> None:
    card.boot.write_text(f"{BOOKWORM}{section}\ndtoverlay=dwc2\n")
    card.setup("usb-serial", "--yes")
    assert card.boot.read_text().startswith(ADDED)


@pytest.mark.parametrize("line", ["otg_mode=1", "dtoverlay=dwc2,dr_mode=host", "dtoverlay=dwc-otg"])
def test_a_host_port_is_left_to_the_person(card: Card, line: str) -> None:
    card.boot.write_text(f"{BOOKWORM}{line}\n")
    before = card.files()
    said = card.setup("usb-serial", "--yes")
    assert said.code == 1
    assert f"makes the port a host (line 24, {line})" in said.text
    assert "put a # before that line" in said.text
    assert card.files() == before


def test_a_compute_module_is_shipped_with_a_host_port(card: Card) -> None:
    card.is_a("Raspberry Pi Compute Module 4 Rev 1.0")
    assert "otg_mode=1 under [cm4]" in card.setup("usb-serial", "--yes").text


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
    said = elsewhere.setup("usb-serial", answer="1\ny\n")
    assert "Which Pi takes this card?\n   1  Zero 2 W\n" in said.text
    assert said.code == 0
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


def test_the_boot_partition_beside_it_as_a_desktop_mounts_both(elsewhere: Card) -> None:
    beside = elsewhere.root.parent / "bootfs"
    beside.mkdir()
    elsewhere.boot.rename(beside / "config.txt")
    said = elsewhere.setup("usb-serial", "--pi", "5", "--yes")
    assert said.code == 0, said.text
    assert (beside / "config.txt").read_text() == ADDED + BOOKWORM


def test_a_boot_partition_that_is_not_mounted(elsewhere: Card) -> None:
    elsewhere.boot.unlink()
    said = elsewhere.setup("usb-serial", "--pi", "zero", "--yes")
    assert f"sudo mount /dev/sdX1 {elsewhere.root}/boot/firmware" in said.text


def test_the_wrong_one_of_the_two_partitions(elsewhere: Card) -> None:
    (elsewhere.root / "config.txt").write_text(BOOKWORM)
    elsewhere.boot.unlink()
    assert "is the card's boot partition" in elsewhere.setup("usb-serial", "--pi", "zero", "--yes").text


@pytest.mark.parametrize("short", SHORT_NAMES)
def test_each_short_name_is_a_pi(short: str) -> None:
    assert known(f"Raspberry Pi {SHORT_NAMES[short]} Rev 1.0") is not None


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


def test_the_older_place_of_config_txt(card: Card) -> None:
    card.boot.rename(card.root / "boot/config.txt")
    assert card.setup("usb-serial", "--yes").code == 0
    assert (card.root / "boot/config.txt").read_text() == ADDED + BOOKWORM


def test_the_newer_place_goes_before_the_older(card: Card) -> None:
    stub = card.write("boot/config.txt", "DO NOT EDIT THIS FILE\n")
    card.setup("usb-serial", "--yes")
    assert card.boot.read_text().startswith(ADDED)
    assert stub.read_text() == "DO NOT EDIT THIS FILE\n"


def test_a_folder_that_is_no_card(card: Card) -> None:
    card.boot.unlink()
    shutil.rmtree(card.root / "etc")
    said = card.setup("usb-serial", "--yes")
    assert (said.code, "is this a Raspberry Pi's SD card?" in said.text) == (1, True)


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


def test_another_identity(card: Card) -> None:
    card.setup("usb-serial", "--yes", "--usb-id", "1209:0001")
    assert "--up --usb-id 1209:0001\n" in (card.root / UNIT).read_text()


@pytest.mark.parametrize("usb_id", ["1d6b", "1d6b:104", "x; reboot", ""])
def test_an_identity_that_is_none(card: Card, usb_id: str) -> None:
    said = card.setup("usb-serial", "--yes", "--usb-id", usb_id)
    assert (said.code, 'such as "1d6b:0104"' in said.text) == (1, True)
