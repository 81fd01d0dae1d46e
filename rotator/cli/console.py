"""The work of the commands that use the console of the running box and do not wait for a motor.

Knows what each sends, what it asks the user first, and what it prints. The box decides whether it obeys; a command that
changes what the box knows looks at the status before it says that something has changed.
"""

from __future__ import annotations

import json
import time
from collections.abc import Sequence
from pathlib import Path

import click

from rotator.cli.announced import boxes
from rotator.cli.box import OK, BoxStatus, Refused, RunningBox, faults, stands, typed
from rotator.cli.failed import FAULTY, NOT_DONE, CommandFailed
from rotator.cli.lines import agree, say
from rotator.cli.reach import consoles
from rotator.cli.stop import stop_boxes
from rotator.control.refused import is_not_fitted, no_relay_in_doubt

LOOK_S = 0.1
CONFIRMED_S = 5.0
"""A motor controller reports its angle within this time after it was confirmed."""
NEAR_DEG = 3.0
"""A count in steps of 5° is at most this far from the angle that was confirmed."""


def tell(path: Path | None, words: Sequence[str]) -> None:
    """Send words to the console and print the answer. Without words: print the list of its words."""
    with RunningBox(path) as box:
        for answer in box.done(" ".join(words) or "help") or [OK]:
            say(answer)


def where(path: Path | None, *, as_json: bool) -> int:
    """Print the status, with the box that it is of where that is not the one of this folder. Returns the exit code:
    FAULTY where an axis has a fault. Raises CommandFailed; with `as_json` an object tells a script the same before."""
    running = [] if path else boxes()
    try:
        with RunningBox(path) as box:
            status = box.status()
            lines = [] if as_json else box.order("status")
    except CommandFailed as fault:
        if as_json:
            say_json({"error": str(fault), "boxes": [each.fields for each in running]})
        raise
    if len(running) == 1 and running[0].folder != Path.cwd():
        status, lines = {"box": running[0].fields, **status}, [f"box: {running[0].named}", *lines]
    if as_json:
        say_json(status)
    for line in lines if not as_json else ():
        say(line)
    return FAULTY if faults(status) else 0


def say_json(value: object) -> None:
    click.echo(json.dumps(value, indent=2, ensure_ascii=False))


def stop(path: Path | None, words: Sequence[str]) -> None:
    """`words`: they do not count, for a stop with more words behind it is a stop."""
    del words
    click.echo(stop_boxes(consoles(path), all_of_them=path is None))


def resume(path: Path | None, *, go_on: bool) -> None:
    """Release the antenna; `go_on`: and track on. Raises CommandFailed for a fault whose cause is still there."""
    with RunningBox(path) as box:
        before = box.status()
        try:
            told = box.done("go-on" if go_on else "resume")
        except Refused as reason:
            raise CommandFailed(str(reason), FAULTY if faults(box.status()) else NOT_DONE) from None
        after = box.status()
    if failed := faults(after):
        raise CommandFailed("\n         ".join(("the cause is still there:", *failed)), FAULTY)
    click.echo(f"The antenna may move again{', and goes on with what it tracked' if go_on else ''}.")
    for line in told if before["stopped_by"] else ():
        say(f"{line[0].upper()}{line[1:].replace('go-on', '`rotator resume --go-on`')}.")
    if go_on:
        return
    if (target := before["tracks"]) and not before["stopped_by"] and not target["recognised"]:
        click.echo(f"It goes on with {target['name']}.")
    if before["storm_park"] and after["moving"]:
        click.echo("It still goes to its park position; `rotator stop` ends that.")


def let_go(path: Path | None, *, yes: bool) -> None:
    with RunningBox(path) as box:
        agree("Without torque an antenna that is out of balance turns. Let go of it?", yes=yes)
        box.done("let-go")
    click.echo("The motors are without torque. Nothing moves until `rotator resume`.")


def confirm(path: Path | None, axis: str, angle_deg: float) -> None:
    """Give an axis its angle, and say what the box takes it for afterwards. Raises CommandFailed if nothing changed.

    A sensor that knows the angle within a turn keeps its own, and takes the turn alone from the person.
    """
    with RunningBox(path) as box:
        before = box.status()
        box.done(f"confirm {axis} {typed(angle_deg)}")
        until_s = time.monotonic() + CONFIRMED_S
        while not (taken := _is_near(after := box.status(), axis, angle_deg)) and time.monotonic() < until_s:
            time.sleep(LOOK_S)
    before_deg, after_deg = before[axis]["angle_deg"], after[axis]["angle_deg"]
    if after_deg is None or (not taken and before_deg is not None and _is_near(after, axis, before_deg)):
        raise CommandFailed(f"{angle_deg:g}° had no effect: {stands(after, axis)}")
    fitted = "" if taken else f", the nearest to {angle_deg:g}° that fits its sensor"
    click.echo(f"Taken: {stands(after, axis)}{fitted}. Before: {stands(before, axis)}.")


def _is_near(status: BoxStatus, axis: str, angle_deg: float) -> bool:
    now_deg = status[axis]["angle_deg"]
    return now_deg is not None and abs(now_deg - angle_deg) <= NEAR_DEG


def relays_checked(path: Path | None, axis: str, *, yes: bool) -> None:
    with RunningBox(path) as box:
        now = box.status()[axis]
        if not now["fitted"]:
            raise Refused(is_not_fitted(axis))
        if now["moving"]:
            raise Refused(f"{axis} turns: first `rotator stop`, then look at its relays")
        if not now["relays_in_doubt"]:
            raise Refused(no_relay_in_doubt(axis))
        agree(f"With both relays of {axis} switched off: does its motor have no current, from either of them?", yes=yes)
        box.done(f"relays-checked {axis}")
        failed = faults(box.status(), (axis,))
    click.echo(
        f"The relays of {axis} count as open." + (" Acknowledge the fault with `rotator resume`." if failed else "")
    )


def pair(path: Path | None, *, listed: bool, revoke: int | None, token: str | None) -> None:
    """Print a code for a browser, the list of all that are paired, or a token alone, for a script. Raises Refused for
    a name that is none."""
    if listed + (revoke is not None) + (token is not None) > 1:
        raise click.UsageError("--list, --revoke and --token: one at a time")
    if token is not None and not token.strip():
        raise Refused("a token needs a name, by which you can revoke it")
    with RunningBox(path) as box:
        if listed:
            text = "\n".join(box.order("pair list"))
            text = text or "Nothing is paired: `rotator pair` prints a code for a browser."
        elif revoke is not None:
            box.order(f"pair revoke {revoke}")
            text = "It is paired no more."
        elif token is not None:
            (text,) = box.order(f"pair token {token}")
        else:
            (code,) = box.order("pair")
            text = f"{code} is the code. Type it on the page within two minutes; the box's display shows it too."
    click.echo(text)


def hand(path: Path | None, words: Sequence[str]) -> None:
    """Move a part of the simulated panel. Raises Refused where there is none."""
    with RunningBox(path) as box:
        box.order(f"panel {' '.join(words)}")
    click.echo("Done.")
