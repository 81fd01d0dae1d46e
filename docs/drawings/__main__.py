"""Writes every drawing into docs/img, or into the folder given; none where a wiring picture is not clean."""

from __future__ import annotations

import sys
from pathlib import Path

from docs.drawings import plug, scene
from docs.drawings.album import sheets
from docs.drawings.inspect import complaints
from docs.drawings.route import route
from docs.drawings.svg import svg
from rotator.store.whole import write_whole

IMAGES = Path(__file__).parents[1] / "img"


def pictures() -> dict[str, str]:
    """Those that are no wiring: name to SVG."""
    return {scene.FILE: scene.scene_svg(), plug.FILE: plug.plug_svg()}


def main() -> None:
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else IMAGES
    drawn = [(sheet, route(sheet)) for sheet in sheets()]
    if found := [f"{sheet.file}: {complaint}" for sheet, wires in drawn for complaint in complaints(sheet, wires)]:
        sys.exit("\n".join(found))
    for sheet, wires in drawn:
        write_whole(folder / f"{sheet.file}.svg", svg(sheet, wires))
    for name, picture in pictures().items():
        write_whole(folder / f"{name}.svg", picture)


if __name__ == "__main__":
    main()
