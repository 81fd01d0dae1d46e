"""The commands of the sky, and the flight over it without a rotor: names, arguments and options."""

from __future__ import annotations

from click import Argument, Choice, Option

from rotator.cli.commands import ANY_WORDS, CONFIG, FAULT, FILE, Commands, Number, command
from rotator.cli.utc import utc_time

HOURS = Number("hours", 0.01, 24 * 14)
JSON = Option(["--json", "as_json"], is_flag=True, help="Print as JSON.")
FROM = Option(
    ["--from", "from_s"], type=utc_time, metavar="UTC", help="Such as 2026-11-22T18:30:00Z; now, if left out."
)
AT = Option(["--at", "at_s"], type=utc_time, metavar="UTC", help="Such as 2026-11-22T18:30:00Z; now, if left out.")
AHEAD = Option(["--hours"], type=HOURS, default=24.0, metavar="HOURS", help="How far ahead; 24 if left out.")

WHERE = command(
    "where",
    "sky:show_where",
    CONFIG,
    JSON,
    AT,
    Argument(["words"], nargs=-1, required=True, metavar="NAME"),
    context_settings=ANY_WORDS,
    says="""Show where NAME is.

    NAME: ISS, 25544, so50, sun, moon, mars, "cas a", another station's locator or country, or AZ EL.
    """,
    examples=["rotator sky where moon --at 2026-12-24T18:00:00Z"],
)
UP = command(
    "up",
    "sky_up:show_up",
    CONFIG,
    JSON,
    AT,
    says="""Show what is above the horizon now.

    Every satellite known, Sun and Moon; the highest first.
    """,
    examples=["rotator sky up"],
)
PASSES = command(
    "passes",
    "sky:show_passes",
    CONFIG,
    JSON,
    FROM,
    AHEAD,
    Option(
        ["--least", "least_deg"],
        type=Number("degrees", 0, 90),
        default=0.0,
        metavar="DEG",
        help="Leave out passes that stay lower than this.",
    ),
    Argument(["names"], nargs=-1, metavar="[NAME...]"),
    says="""Show when each NAME rises and sets.

    Without NAME: every satellite known.
    """,
    examples=["rotator sky passes iss so50 --hours 12 --least 10"],
)
PLAN = command(
    "plan",
    "sky:show_plan",
    CONFIG,
    JSON,
    FROM,
    AHEAD,
    says="""Show which passes the antenna flies.

    Of the targets that [[sky.follow]] names: when it sets off for each pass, where it waits, and why a pass is left
    out. The antenna begins at its park position.
    """,
    examples=["rotator sky plan --hours 12"],
)
ELEMENTS = command(
    "elements",
    "sky_elements:show_elements",
    CONFIG,
    JSON,
    says="""Show which elements there are, and how old.

    And what came of fetching them.
    """,
    examples=["rotator sky elements"],
)
SKY = Commands(
    "sky",
    says="""Show where satellites, Sun and Moon are, and when they pass.

    It needs [station] in the file, and for satellites [sky] elements.
    """,
    examples=["rotator sky where moon --config station.toml"],
)
SKY.under("Commands", WHERE, UP, PASSES, PLAN, ELEMENTS)

REHEARSE = command(
    "rehearse",
    "rehearse:rehearse_pass",
    CONFIG,
    FAULT,
    Argument(["word"], required=False, metavar="[PASS.csv|NAME]"),
    Option(
        ["--via"],
        type=Choice(["gs232", "rotctld", "track"]),
        default="gs232",
        help="The protocol of the orders; `track`: the box knows the pass beforehand.",
    ),
    Option(["--trace"], type=FILE, help="Write the flight to this CSV file."),
    Option(["--svg"], type=FILE, help="Draw the flight into this SVG file."),
    Option(["--json", "as_json"], is_flag=True, help="Print the summary as JSON."),
    Option(["--target"], metavar="NAME", help="Fly the next pass of a satellite, Sun or Moon, tracked by the box."),
    Option(
        ["--at", "at_s"],
        type=utc_time,
        metavar="UTC",
        help="The pass begins then, and is recognised in the orders; with --target: the first pass that ends after "
        "this.",
    ),
    Option(["--arduino"], is_flag=True, help="Fly the pass with the emulated Arduino instead of the box."),
    says="""Fly a satellite pass on the simulated rotor.

    It prints how far off the antenna was; the exit code is 3 where a --fault holds an axis at the end. The pass is a
    NAME of the list that `rotator rehearse` prints, or a file.

    The first line of such a file is t,az,el. Each further line is a moment in seconds, and the satellite's azimuth and
    elevation in degrees, with decimal points: 12.5,274.6,8.1. Your tracking program can export them. With an azimuth
    above 360 or an elevation above 90 the file names the rotor's turns.

    The time is simulated: ten minutes take some seconds. So is the rotor, also where
    the file of --config names a real one.
    """,
    examples=[
        "rotator rehearse                  # lists the passes that are there",
        "rotator rehearse north-1-iss",
        "rotator rehearse mine.csv --config station.toml --svg flight.svg",
    ],
)
