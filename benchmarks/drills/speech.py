"""What a program or a person of a drill sends: an order in the words of its protocol.

Knows how each order is written: one table a protocol. Does not know what the box makes of it.
"""

from __future__ import annotations

from benchmarks.drills.script import Event

PROTOCOLS = {
    "gs232b": "gs232b",
    "gs232a": "gs232a",
    "rotctld": "rotctld",
    "rotctld-2": "rotctld",
    "easycomm2": "easycomm2",
    "easycomm3": "easycomm3",
    "pstrotator": "pstrotator",
}
TABLE = "table "
Forms = dict[str, str]
"""By the order, or by the order and the texts that belong to it: its form. Numbers stand by their place."""

GS232: Forms = {
    "aim": "W{0:03.0f} {1:03.0f}",
    "aim-azimuth": "M{0:03.0f}",
    **{f"jog {way}": letter for way, letter in {"cw": "R", "ccw": "L", "up": "U", "down": "D"}.items()},
    "stop": "S",
    "stop-axis azimuth": "A",
    "stop-axis elevation": "E",
    "run-list": "T",
    "calibrate azimuth low": "O",
    "calibrate azimuth high": "F",
    "calibrate elevation low": "O2",
    "calibrate elevation high": "F2",
    "speed": "X{0:.0f}",
    "ask": "C2",
}
ROTCTLD: Forms = {
    "aim": "P {0:.2f} {1:.2f}",
    **{f"jog {way}": f"M {number} -1" for way, number in {"cw": 16, "ccw": 8, "up": 2, "down": 4}.items()},
    "stop": "S",
    "park": "K",
    "ask": "p",
}
EASYCOMM: Forms = {
    "aim": "AZ{0:.1f} EL{1:.1f}",
    "aim-azimuth": "AZ{0:.1f}",
    "aim-elevation": "EL{0:.1f}",
    **{f"jog {way}": word for way, word in {"cw": "MR", "ccw": "ML", "up": "MU", "down": "MD"}.items()},
    "stop": "SA SE",
    "stop-axis azimuth": "SA",
    "stop-axis elevation": "SE",
    "park": "PARK",
    "ask": "AZ EL",
}
PSTROTATOR: Forms = {
    "aim": "<PST><AZIMUTH>{0:.1f}</AZIMUTH><ELEVATION>{1:.1f}</ELEVATION></PST>",
    "aim-azimuth": "<PST><AZIMUTH>{0:.1f}</AZIMUTH></PST>",
    "stop": "<PST><STOP>1</STOP></PST>",
    "park": "<PST><PARK>1</PARK></PST>",
    "ask": "<PST>AZ?</PST>",
}
CONSOLE: Forms = {
    "aim": "point {0:g} {1:g}",
    "jog": "jog {text} {0:.3g}",
    **{word: word for word in ("stop", "resume", "let-go", "take", "give-back")},
    **{word: f"{word} {{text}}" for word in ("home", "relays-checked", "hold", "mode", "track")},
    "storm": "park",
    "confirm": "confirm {text} {0:.2f}",
    "ask": "status",
}
SPOKEN: dict[str, tuple[Forms, str]] = {
    "gs232a": (GS232, "\r"),
    "gs232b": (GS232, "\r"),
    "rotctld": (ROTCTLD, "\n"),
    "easycomm2": (EASYCOMM, "\n"),
    "easycomm3": (EASYCOMM, "\n"),
    "pstrotator": (PSTROTATOR, ""),
    "console": (CONSOLE, "\n"),
}
"""Each protocol's forms, and the end of its lines."""


def said(event: Event) -> bytes:
    """The bytes of an event of a link or a console; empty: this protocol has no words for it."""
    if event.what == "junk":
        return event.text(0).encode("latin-1") + b"\r\n"  # else the next order would be a part of it
    forms, end = SPOKEN[PROTOCOLS.get(event.who, "console")]
    numbers = [each for each in event.args if isinstance(each, (int, float))]
    text = " ".join(each for each in event.args if isinstance(each, str))
    if forms is GS232:
        # The command set has neither negative elevations nor decimals.
        numbers = [max(0.0, each) for each in numbers]
        if event.what == "list":
            return ("W" + " ".join(f"{each:03.0f}" for each in numbers) + end).encode()
    if event.what == "track" and text.startswith(TABLE):
        rows = ["t,az,el", *text.removeprefix(TABLE).split(";")]
        return "\n".join(("table", *(f"table {row}" for row in rows), "track-table table\n")).encode()
    form = forms.get(f"{event.what} {text}".strip(), forms.get(event.what, ""))
    return (form.format(*numbers, text=text) + end).encode() if form else b""
