"""Power lost in mid-write: the saved state is the old one or the new one, never half of either.

A file system of its own (ext4) on a block device; the power is cut by copying the device as it is at that moment,
without a word to the file system on it, and mounting the copy as after a reboot.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from rotator.store.whole import write_whole
from tests.kernel.bench.waiting import until

CUTS = 20
SIZE_BYTES = 4 << 20
WRITER = """
import json, sys
from itertools import count
from pathlib import Path
from rotator.store.whole import write_whole
for number in count(1):
    write_whole(Path(sys.argv[1]), json.dumps({"number": number, "filling": [number] * 1500}))
"""


@contextmanager
def mounted(image: Path, place: Path) -> Iterator[Path]:
    place.mkdir(exist_ok=True)
    subprocess.run(["mount", "-o", "loop", image, place], check=True)
    try:
        yield place
    finally:
        subprocess.run(["umount", place], check=True)


def test_what_was_saved_is_whole_whenever_the_power_goes(tmp_path: Path) -> None:
    image, copy = tmp_path / "disk", tmp_path / "copy"
    with image.open("wb") as file:
        file.truncate(SIZE_BYTES)
    mkfs = shutil.which("mkfs.ext4") or pytest.fail("mkfs.ext4 is missing: sudo apt install e2fsprogs")
    subprocess.run([mkfs, "-q", "-O", "^metadata_csum_seed,^orphan_file", image], check=True)
    seen: list[int] = []
    with mounted(image, tmp_path / "before") as before:
        state = before / "state.json"
        write_whole(state, json.dumps({"number": 0, "filling": [0] * 1500}))
        writer = subprocess.Popen([sys.executable, "-c", WRITER, state])
        try:
            until(lambda: json.loads(state.read_text())["number"] > 0, "the first state of the writer")
            for _ in range(CUTS):
                shutil.copyfile(image, copy)
                with mounted(copy, tmp_path / "after") as after:
                    saved = json.loads((after / "state.json").read_text())
                assert saved["filling"] == [saved["number"]] * 1500
                seen.append(saved["number"])
        finally:
            writer.kill()
            writer.wait()
    assert len(set(seen)) > CUTS // 2, f"the writer hardly wrote between the cuts: {seen}"
    assert seen == sorted(seen)
