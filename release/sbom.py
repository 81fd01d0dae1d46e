"""The list of every package in the program's folder, with version and licence: CycloneDX in JSON, by cyclonedx-py.

Knows that tool's command line. What is listed is what lies there, not what a file says should.
"""

from __future__ import annotations

import json
import shutil
import sys
import tempfile
from pathlib import Path

from release.environment import PACKAGES
from release.source import Source, run


def write(environment: Path, source: Source, into: Path) -> Path:
    """The list of one folder that `environment.make` made. It names no place and no time of the builder."""
    with tempfile.TemporaryDirectory() as scratch:
        # The tool starts the Python of an environment. That of another architecture does not run here.
        here = Path(scratch) / "here"
        (here / "bin").mkdir(parents=True)
        (here / "bin/python").symlink_to(sys.executable)
        minor = sys.version_info.minor
        packages = here / f"lib/python3.{minor}/site-packages"
        packages.parent.mkdir(parents=True)
        packages.symlink_to((environment / PACKAGES).resolve())
        shutil.copy(environment / "pyvenv.cfg", here)
        made = into / "gs232-rotator.cdx.json"
        run(
            *(Path(sys.executable).with_name("cyclonedx-py"), "environment", "--output-reproducible"),
            *("--output-format", "JSON", "--output-file", made, "--pyproject", source.folder / "pyproject.toml"),
            here / "bin/python",
            epoch_s=source.epoch_s,
        )
    # The tool finds no version in a pyproject.toml that takes it from the source.
    text = json.loads(made.read_text(encoding="utf-8"))
    text["metadata"]["component"]["version"] = source.version
    made.write_text(json.dumps(text, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    return made
