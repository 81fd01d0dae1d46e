"""The option --fault: which named fault of the simulator strikes when.

Knows the option's form. Knows no fault: the simulated rotor does.
"""

from __future__ import annotations

import click

from firmware_sim.rotors.rotor import SimRotor


def parse_faults(texts: tuple[str, ...], world: SimRotor | None) -> list[tuple[float, str]]:
    """`name@seconds` to (seconds, name); without seconds, at once. Ends the program on a name there is not."""
    if not texts:
        return []
    if world is None:
        raise click.UsageError("--fault is for the simulator; this configuration drives real hardware")
    if "list" in texts:
        click.echo("\n".join(sorted(world.faults)))
        raise SystemExit(0)
    plan = []
    for text in texts:
        name, _, moment = text.partition("@")
        if name not in world.faults:
            raise click.UsageError(f"no fault called {name}; --fault list shows them")
        try:
            plan.append((float(moment or 0), name))
        except ValueError:
            raise click.UsageError(f"{text}: the moment after @ is a number of seconds") from None
    return plan
