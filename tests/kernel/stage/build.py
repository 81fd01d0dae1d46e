"""From Debian's packages to something QEMU can boot: the kernel, its modules, and a gpio-sim that Debian leaves out.

Knows the modules that the tests need and what must be changed in gpio-sim. Does not know how it is booted.
"""

from __future__ import annotations

import hashlib
import lzma
import os
import shutil
import struct
import subprocess
from pathlib import Path

from tests.kernel.stage.debian import KernelPackages, StageError, download, run, unpack, unpack_source

MODULES = (
    *("9pnet_virtio", "virtio_pci", "9p", "overlay"),  # the host's files
    *("i2c-dev", "vhci-hcd", "i2c-tiny-usb"),  # an I2C adapter whose far end is ours
    *("dummy_hcd", "libcomposite", "usb_f_acm", "cdc-acm"),  # a USB cable between two ports of this machine
    *("vcan", "can-raw", "softdog", "configfs"),
    *("loop", "ext4"),  # a file system that loses its power
)

GPIO_SIM_FILES = ("drivers/gpio/gpio-sim.c", "drivers/gpio/gpiolib.h", "kernel/irq/irq_sim.c")
KBUILD = "obj-m := gpio-sim.o\ngpio-sim-y := both.o\n"
BOTH = '#include "irq_sim.c"\n#include "simulated.c"\n'
"""Debian builds neither in; one module holds both."""

IRQ_CHANGE = ("handle_simple_irq(irq_to_desc(irqnum));", "generic_handle_irq(irqnum);")
"""irq_to_desc is not exported to modules."""
PERSIST_PARAMETER = (
    "static void gpio_sim_free(",
    "static bool persist;\nmodule_param(persist, bool, 0644);\n\nstatic void gpio_sim_free(",
)
PERSIST = (
    "= gpiochip_get_data(gc);\n\n\tmutex_lock(&chip->lock);\n\t__assign_bit(offset, chip->value_map, !!test_bit(",
    "= gpiochip_get_data(gc);\n\n\tif (persist)\n\t\treturn;\n\n"
    "\tmutex_lock(&chip->lock);\n\t__assign_bit(offset, chip->value_map, !!test_bit(",
)
"""As Raspberry Pi kernels do it: a line that is let go of stays driven."""

XZ, ZSTD = b"\xfd7zXZ\x00", b"\x28\xb5\x2f\xfd"


def recipe() -> str:
    """Changes whenever this file does: what an older one built is built anew."""
    return hashlib.sha256(Path(__file__).read_bytes()).hexdigest()[:12]


def fetch(packages: KernelPackages, scratch: Path) -> None:
    """Debian's packages, into a folder that is not there yet."""
    scratch.mkdir()
    download(packages, scratch)


def build(packages: KernelPackages, scratch: Path, folder: Path) -> None:
    """`vmlinux` and `modules/` (numbered in the order of loading) in `folder`. Works in the scratch folder."""
    root = scratch / "root"
    unpack(packages, scratch, root)
    folder.mkdir()
    (folder / "vmlinux").write_bytes(_kernel_in((root / f"boot/vmlinuz-{packages.release}").read_bytes()))
    gpio_sim = _gpio_sim(packages, scratch, root)
    _collect_modules(packages, root, gpio_sim, folder / "modules")


def _kernel_in(image: bytes) -> bytes:
    """The ELF inside a bzImage (boot protocol 2.08, Documentation/x86/boot.rst): QEMU unpacks it faster than itself."""
    real_mode_sectors = (image[0x1F1] or 4) + 1
    offset, length = struct.unpack_from("<II", image, 0x248)
    payload = image[real_mode_sectors * 512 + offset :][:length]
    if payload.startswith(XZ):
        return lzma.LZMADecompressor().decompress(payload)
    if payload.startswith(ZSTD):
        return subprocess.run(["zstd", "-dcq"], input=payload[:-4], capture_output=True, check=True).stdout
    raise StageError("the kernel is compressed in a way this stage does not know")


def _gpio_sim(packages: KernelPackages, scratch: Path, root: Path) -> Path:
    folder = scratch / "gpio-sim"
    folder.mkdir()
    unpack_source(packages, scratch, GPIO_SIM_FILES)
    irq = _changed((scratch / "irq_sim.c").read_text(), IRQ_CHANGE)
    simulated = _changed((scratch / "gpio-sim.c").read_text(), PERSIST, PERSIST_PARAMETER)
    (folder / "irq_sim.c").write_text(irq)
    (folder / "simulated.c").write_text(simulated)
    shutil.move(scratch / "gpiolib.h", folder)
    (folder / "both.c").write_text(BOTH)
    (folder / "Kbuild").write_text(KBUILD)
    headers = root / f"usr/src/linux-headers-{packages.release}"
    makefile = headers / "Makefile"
    makefile.write_text(makefile.read_text().replace("/usr/src/", f"{root}/usr/src/"))
    # Without an empty BTF setting newer kernels ask for pahole.
    jobs = f"-j{os.cpu_count()}"
    run(["make", jobs, "-C", str(headers), f"M={folder}", "CONFIG_DEBUG_INFO_BTF_MODULES=", "modules"], scratch)
    return folder / "gpio-sim.ko"


def _changed(text: str, *changes: tuple[str, str]) -> str:
    for old, new in changes:
        if text.count(old) != 1:
            raise StageError(f"gpio-sim's source has changed: it has {old!r} {text.count(old)} times, not once")
        text = text.replace(old, new)
    return text


def _collect_modules(packages: KernelPackages, root: Path, gpio_sim: Path, folder: Path) -> None:
    folder.mkdir()
    run(["depmod", "-b", str(root), packages.release], root)
    asked = ["modprobe", "-d", str(root), "-S", packages.release, "--show-depends"]
    paths: dict[Path, None] = {}
    for module in MODULES:
        for line in run([*asked, module], root).splitlines():
            match line.split():
                case ["insmod", name, *_]:
                    paths[Path(name)] = None
    for count, path in enumerate((*paths, gpio_sim)):
        content = path.read_bytes()
        if path.suffix == ".xz":
            content = lzma.decompress(content)
        (folder / f"{count:02d}-{path.name.removesuffix('.xz')}").write_bytes(content)
