"""`rotator off`: switches every relay line off when no box is running, and prints the lines.

`rotator.assembly.lines_off` knows the lines and switches them.
"""

from __future__ import annotations

from pathlib import Path

import click

from rotator.assembly.lines_off import switch_lines_off
from rotator.config.load import load


def relays_off(path: Path | None) -> None:
    config = load(path)
    if config.simulated:
        click.echo("simulated: there is no relay to open")
        return
    lines = switch_lines_off(config)
    if lines:
        click.echo(f"off: {', '.join(f'{name} (GPIO{offset})' for name, offset in lines.items())}")
    else:
        click.echo(f"{config.rotor.type}: there is no relay to open; {config.kind.holds}")
