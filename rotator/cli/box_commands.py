"""The commands that talk to the running box: names, arguments and options.

`console`, `moves` and `track` do the work.
"""

from __future__ import annotations

import click
from click import Argument, Choice, Option

from rotator.cli.commands import ANY_WORDS, CONFIG, YES, Number, NumbersCommand, command

AXIS = Argument(["axis"], type=Choice(["azimuth", "elevation"], case_sensitive=False), metavar="azimuth|elevation")
WAIT = Option(["--no-wait", "wait"], is_flag=True, flag_value=False, default=True, help="Give the order, and end.")

WHERE = command(
    "where",
    "console:where",
    CONFIG,
    Option(["--json", "as_json"], is_flag=True, help="One object; its fields: rotator help commands."),
    says="""Show where the antenna is, who moves it, and what is wrong.

    The exit code is 3 where an axis has a fault. With --json, `box` names a box of another folder; and where none
    answers, or more than one, the object is `error` and the `boxes` that run.
    """,
    examples=["rotator where", "rotator where --json", "rotator where && echo healthy"],
)
POINT = command(
    "point",
    "moves:point",
    CONFIG,
    WAIT,
    Argument(["azimuth_deg"], type=Number("degrees"), metavar="AZIMUTH"),
    Argument(["elevation_deg"], type=Number("degrees"), metavar="[ELEVATION]", required=False),
    cls=NumbersCommand,
    says="""Point the antenna, and wait until it has arrived.

    AZIMUTH counts from north over east, ELEVATION from the horizon, in degrees. Above 360 AZIMUTH names a turn of the
    rotor. Without ELEVATION that axis keeps what it has. Ctrl-C stops the antenna; a terminal that closes does not: it
    goes on to its place. The exit code is 0 when it has arrived, 3 when a fault stopped it.
    """,
    examples=["rotator point 180 45", "rotator point 237,5 12,5"],
)
TRACK = command(
    "track",
    "track:begin",
    CONFIG,
    Option(["--clock-is-right"], is_flag=True, help="You have seen that the computer's clock shows the right time."),
    Argument(["words"], nargs=-1, metavar="[NAME|LOCATOR|AZ EL|FILE.csv|plan|off]"),
    context_settings=ANY_WORDS,
    says="""Let the box track a target by itself, from pass to pass.

    NAME: ISS, 25544, so50, sun, moon, mars, "cas a". It needs [station] in the box's file, and for satellites [sky]
    elements. The antenna goes to where the target rises and waits there. Any other order ends it. `plan` goes back to
    what [[sky.follow]] names; `off` tracks nothing. Without words it tells what is tracked. FILE.csv is a table
    t,az,el: t in seconds from now, or in UTC as 2026-11-22T18:30:00Z.
    """,
    examples=["rotator track iss", "rotator track moon", 'rotator track "jn58td long"', "rotator track off"],
)
JOG = command(
    "jog",
    "moves:jog",
    CONFIG,
    WAIT,
    Argument(["direction"], type=Choice(["cw", "ccw", "up", "down"], case_sensitive=False), metavar="cw|ccw|up|down"),
    Argument(["seconds"], type=Number("seconds", 0.05)),
    cls=NumbersCommand,
    says="""Turn one axis for some SECONDS, 5 at most.

    cw is clockwise seen from above, ccw the other way. It works before calibration too. Ctrl-C stops the antenna.
    """,
    examples=["rotator jog cw 2", "rotator jog down 0,5"],
)
PARK = command(
    "park",
    "moves:park",
    CONFIG,
    WAIT,
    says="""Go to the park position, and stay until `rotator resume`.

    It goes now, and ends what a tracking program does. Ctrl-C stops the antenna; a terminal that closes does not.
    """,
    examples=["rotator park", "rotator resume    # afterwards, before anything else moves"],
)
STOP = command(
    "stop",
    "console:stop",
    CONFIG,
    Argument(["words"], nargs=-1, metavar=""),
    says="""Stop the antenna until `rotator resume`. Until then no link can move it.

    Without --config it stops every box that you run, in whichever folder, and the service; with sudo every user's.
    """,
    examples=["rotator stop"],
)
RESUME = command(
    "resume",
    "console:resume",
    CONFIG,
    Option(["--go-on"], is_flag=True, help="Also track again what the stop, the fault or a jog has ended."),
    says="""Let the antenna move again after a stop. Acknowledges faults.

    Nothing moves before the next order, unless --go-on asks for it. The exit code is 3 while the cause of a fault is
    still there.
    """,
    examples=["rotator resume", "rotator resume --go-on"],
)
HOME = command(
    "home",
    "moves:home",
    CONFIG,
    YES,
    AXIS,
    says="""Turn an axis that counts pulses to its end stop.

    Its count begins there. Watch the antenna; Ctrl-C stops it.
    """,
    examples=["rotator home azimuth"],
)
CONFIRM = command(
    "confirm",
    "console:confirm",
    CONFIG,
    AXIS,
    Argument(["angle_deg"], type=Number("degrees"), metavar="DEGREES"),
    cls=NumbersCommand,
    says="""Say at which angle an axis stands, in DEGREES.

    A moteus behind a gear needs it after power-on. An axis that measures its angle refuses it.
    """,
    examples=["rotator confirm azimuth 123,5"],
)
RELAYS_CHECKED = command(
    "relays-checked",
    "console:relays_checked",
    CONFIG,
    YES,
    AXIS,
    says="Say that you have seen: both relays of an axis are open.",
    examples=["rotator relays-checked azimuth"],
)
LET_GO = command(
    "let-go",
    "console:let_go",
    CONFIG,
    YES,
    says="""Switch off the motors' torque until `rotator resume`.

    An antenna out of balance then turns.
    """,
    examples=["rotator let-go"],
)
PANEL = command(
    "panel",
    "console:hand",
    CONFIG,
    Argument(["words"], nargs=-1, required=True, metavar="mode|knob|jog|stop ..."),
    context_settings=ANY_WORDS,
    says="""Move a switch or a knob of a simulated box's panel.

    A real panel has hands of its own.

    \b
    mode auto|manual|jog|park
    knob azimuth|elevation SHARE     of its travel, 0 to 1
    jog cw|ccw|up|down SECONDS       held for so long
    stop press|release
    """,
    examples=["rotator panel mode manual", "rotator panel knob azimuth 0,5", "rotator panel jog cw 2"],
)
PAIR = command(
    "pair",
    "console:pair",
    CONFIG,
    Option(["--list", "listed"], is_flag=True, help="List all that are paired, with their numbers."),
    Option(["--revoke"], type=click.IntRange(1, 1_000_000), metavar="NUMBER", help="Pair this one no more."),
    Option(["--token"], metavar="NAME", help="Print a token for a program of this name."),
    says="Print the code that pairs a browser with the box.",
    examples=["rotator pair", "rotator pair --list", "rotator pair --token logger"],
)
TELL = command(
    "tell",
    "console:tell",
    CONFIG,
    Argument(["words"], nargs=-1, type=click.UNPROCESSED),
    context_settings=ANY_WORDS,
    says="""Send WORDS to the box's console, for scripts. Without WORDS: list the words.

    It ends as soon as the box has the order.
    """,
    examples=["rotator tell help", "rotator tell status json"],
)
