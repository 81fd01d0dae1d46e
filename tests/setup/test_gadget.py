"""The USB device is built and taken down as configfs wants it, from any state it may have been left in.

A folder stands in for configfs; a removal obeys its rule: what a person made inside goes first, attributes go along.
That a real kernel takes it, and that a PC's side sees it, is told in tests/kernel.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from rotator.setup.gadget import Identity, down, up
from rotator.setup.plan import SetupError

IDENTITY = Identity("10000000abcdef01")
BUILT = ["strings/0x409", "configs/c.1/strings/0x409", "configs/c.1", "functions/acm.usb0"]
DEFAULT = {"strings", "configs", "functions"}


@pytest.fixture
def kernel(tmp_path: Path) -> Path:
    for folder in ("config/usb_gadget", "udc/fe980000.usb"):
        (tmp_path / folder).mkdir(parents=True)
    return tmp_path


def rmdir(folder: Path) -> None:
    """As configfs: refuses while something a person made is inside; attributes and its own folders go along."""
    for inside in folder.iterdir():
        made = inside.is_symlink() or (inside.is_dir() and (inside.name not in DEFAULT or any(inside.iterdir())))
        if made:
            raise OSError(39, "Directory not empty", str(folder))
    shutil.rmtree(folder)


def raised(kernel: Path, identity: Identity = IDENTITY) -> str:
    return up(kernel / "config", kernel / "udc", identity, rmdir)


def lowered(kernel: Path) -> None:
    down(kernel / "config", rmdir)


def state(kernel: Path) -> dict[str, str]:
    gadget = kernel / "config/usb_gadget/rotator"
    return {str(path.relative_to(gadget)): path.read_text() for path in gadget.rglob("*") if path.is_file()}


def test_what_the_pc_is_told(kernel: Path) -> None:
    assert raised(kernel) == "fe980000.usb"
    told = state(kernel)
    assert told["UDC"] == "fe980000.usb"
    assert (told["idVendor"], told["idProduct"]) == ("0x1d6b", "0x0104")
    assert (told["bDeviceClass"], told["bDeviceSubClass"]) == ("0x02", "0x02")
    assert told["strings/0x409/serialnumber"] == "10000000abcdef01"
    assert told["strings/0x409/product"] == "GS-232 Rotator"
    link = kernel / "config/usb_gadget/rotator/configs/c.1/acm.usb0"
    assert link.resolve() == kernel / "config/usb_gadget/rotator/functions/acm.usb0"


def test_up_twice_touches_nothing(kernel: Path) -> None:
    raised(kernel)
    udc = kernel / "config/usb_gadget/rotator/UDC"
    before = udc.stat().st_mtime_ns, udc.stat().st_ino
    assert raised(kernel) == "fe980000.usb"
    assert (udc.stat().st_mtime_ns, udc.stat().st_ino) == before


def test_down_leaves_nothing(kernel: Path) -> None:
    raised(kernel)
    lowered(kernel)
    assert os.listdir(kernel / "config/usb_gadget") == []
    lowered(kernel)


@pytest.mark.parametrize("folders", [BUILT[:count] for count in range(len(BUILT) + 1)], ids=str)
def test_a_half_built_one_is_no_obstacle(kernel: Path, folders: list[str]) -> None:
    gadget = kernel / "config/usb_gadget/rotator"
    for folder in ("", *folders):
        (gadget / folder).mkdir(parents=True, exist_ok=True)
    (gadget / "idVendor").write_text("0x0000")
    assert raised(kernel) == "fe980000.usb"
    lowered(kernel)
    assert not gadget.exists()


def test_the_first_controller_there_is(kernel: Path) -> None:
    (kernel / "udc/dummy_udc.0").mkdir()
    assert raised(kernel) == "dummy_udc.0"


def test_a_kernel_that_refuses_leaves_nothing_behind(kernel: Path) -> None:
    # A folder where the kernel wants to be written to: the last step fails.
    (kernel / "config/usb_gadget/rotator/UDC").mkdir(parents=True)
    with pytest.raises(SetupError, match="cannot be"):
        raised(kernel)


@pytest.mark.parametrize(
    ("gone", "owner", "said"),
    [
        ("udc/fe980000.usb", "", "no USB device controller: run `sudo rotator setup usb-serial`, reboot"),
        ("config/usb_gadget", "", "modprobe libcomposite"),
        ("", "config/usb_gadget/mass_storage/UDC", r"fe980000\.usb is taken by mass_storage"),
        ("", "udc/fe980000.usb/function", "taken by g_ether"),
    ],
)
def test_a_controller_that_is_not_to_be_had(kernel: Path, gone: str, owner: str, said: str) -> None:
    if gone:
        (kernel / gone).rmdir()
    if owner:
        (kernel / owner).parent.mkdir(exist_ok=True)
        (kernel / owner).write_text("g_ether\n" if owner.endswith("function") else "fe980000.usb\n")
    with pytest.raises(SetupError, match=said):
        raised(kernel)
    assert not (kernel / "config/usb_gadget/rotator").exists()
