"""Describes the values of `scene` for programs: the box, its last minutes, the path of a pass, and the live picture.

Knows JSON schemas. Does not know how the values are made.
"""

from __future__ import annotations

from rotator.protocols.panel_words import TURNS
from rotator.web.schema import NUMBER, TEXT, WHOLE, YES, Schema, choice, component, list_of, object_of, or_null, the

_PAIR = list_of(NUMBER, 2)
_WAY = or_null(the("true azimuth and elevation", _PAIR))
_RANGE = object_of({"min_deg": NUMBER, "max_deg": NUMBER})

BOX: Schema = object_of(
    {
        "version": TEXT,
        "simulated": the("nothing real turns", YES),
        "beam_deg": the("how wide the antenna sees", NUMBER),
        "where": or_null(the("latitude and longitude, to a whole degree for who is not paired", _PAIR)),
        "azimuth": _RANGE,
        "elevation": _RANGE,
        "tolerance_deg": the("of azimuth and elevation: so near is at the target", _PAIR),
        "park": the("azimuth and elevation", _PAIR),
        "horizon": the("azimuth, and the least elevation there", list_of(_PAIR)),
        "sectors": the(
            "where the antenna may not go", list_of(object_of({"name": TEXT, "azimuth": _PAIR, "elevation": _PAIR}))
        ),
    }
)
PAST: Schema = object_of(
    {
        "every_s": NUMBER,
        "rows": the(
            "seconds from now, azimuth, its target, elevation, its target, error",
            list_of(list_of(or_null(NUMBER), 6)),
        ),
    }
)
PATH: Schema = object_of(
    {
        "key": the("no other flight has it", TEXT),
        "name": TEXT,
        "points": the("azimuth and elevation", list_of(_PAIR)),
    }
)
LOG: Schema = object_of(
    {
        "lines": list_of(
            object_of(
                {
                    "at_s": the("seconds since 1970", NUMBER),
                    "rank": choice("note", "warning", "error"),
                    "text": TEXT,
                }
            )
        )
    }
)
_LINK = object_of(
    {
        "name": TEXT,
        "protocol": TEXT,
        "where": TEXT,
        "state": TEXT,
        "out": the("no program can use it now", YES),
        "heard": the("the last line that a program sent", TEXT),
        "count": the("bytes that came so far", WHOLE),
    }
)
PICTURE: Schema = object_of(
    {
        "status": component("status"),
        "headline": TEXT,
        "mood": choice("good", "plain", "warns", "alarms"),
        "passes": the("every fault ends by itself", YES),
        "antenna": _WAY,
        "target": _WAY,
        "azimuth_deg": or_null(NUMBER),
        "elevation_deg": or_null(NUMBER),
        "azimuth_target_deg": or_null(NUMBER),
        "elevation_target_deg": or_null(NUMBER),
        "readings": the("of both sensors, as they come", list_of(or_null(NUMBER), 2)),
        "off_deg": the("from the target", or_null(NUMBER)),
        "starts": the("of the relays", or_null(WHOLE)),
        "tracking": the("off, planning, tracking; ended:, refused: or rests: and why", TEXT),
        "rise_or_set": TEXT,
        "path": the("empty, or the key of the flight that /api/path has", TEXT),
        "stops": the("how often a person has stopped it since the program began", WHOLE),
        "utc_s": the("the box's clock, in seconds since 1970", NUMBER),
        "lamps": the("of the relays", object_of({turn: choice("on", "off", "doubted") for turn in TURNS})),
        "lcd": the("the rows of the display", list_of(TEXT)),
        "mover": the("whose orders move the antenna, by name", TEXT),
        "holder": TEXT,
        "stopper": TEXT,
        "mode_by": TEXT,
        "mode_switch": the("a front panel has one, and it comes first", YES),
        "notes": list_of(TEXT),
        "links": list_of(_LINK),
    }
)
"""All values that may change at any time."""
