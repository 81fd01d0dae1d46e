"""What a compass has learnt of its own errors, kept in a small JSON file, for the chip forgets it without power.

Knows the file's form, and that a damaged or foreign file is as good as none. Does not know what the bytes mean.
"""

from __future__ import annotations

import json
import logging
from pathlib import Path

from rotator.store.whole import write_whole

log = logging.getLogger(__name__)

FORMAT = "rotator compass 1"
OFFSETS_COUNT = 22


def encode(offsets: bytes) -> str:
    return json.dumps({"format": FORMAT, "offsets": offsets.hex(" ")}, indent=1) + "\n"


def decode(text: str) -> bytes:
    """Raises ValueError where that is not the box's."""
    try:
        whole = json.loads(text)
        if not isinstance(whole, dict) or whole.get("format") != FORMAT:
            raise ValueError("it is not the box's")
        offsets = bytes.fromhex(whole["offsets"])
    except (ValueError, KeyError, TypeError, RecursionError) as fault:
        raise ValueError(str(fault) or type(fault).__name__) from fault
    if len(offsets) != OFFSETS_COUNT:
        raise ValueError(f"it holds {len(offsets)} bytes, not {OFFSETS_COUNT}")
    return offsets


class CompassFile:
    """The file. `load` it, `save` what is new; neither ever raises. `trouble` says why it could not be written."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.trouble = ""
        self._kept: bytes | None = None

    def load(self) -> bytes | None:
        """What the compass knew; None where there is no file, or none that can be believed."""
        try:
            self._kept = decode(self.path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return None
        except (OSError, ValueError) as fault:
            log.warning("%s: ignored, the compass learns its errors anew: %s", self.path, fault)
            return None
        return self._kept

    def save(self, offsets: bytes) -> None:
        """Keep what a compass knows once its calibration is complete. What is there already is not written again."""
        if offsets == self._kept:
            return
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            write_whole(self.path, encode(offsets))
        except OSError as fault:
            self.trouble = f"{self.path}: what the compass learnt cannot be kept: {fault}"
            log.error("%s", self.trouble)
            return
        self._kept, self.trouble = offsets, ""
