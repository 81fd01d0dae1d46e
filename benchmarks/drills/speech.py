"""What a program or a person of a drill sends: an order in the words of its protocol.

Knows how each order is written. Does not know what the box makes of it.
"""

from __future__ import annotations

from benchmarks.drills.script import PAGE, Event

PROTOCOLS = {
    "gs232b": "gs232b",
    "gs232a": "gs232a",
    "rotctld": "rotctld",
    "rotctld-2": "rotctld",
    "easycomm2": "easycomm2",
    "easycomm3": "easycomm3",
    "pstrotator": "pstrotator",
}
ROTCTLD_WAYS = {"cw": 16, "ccw": 8, "up": 2, "down": 4}
TABLE = "table "
GS232_WAYS = {"cw": "R", "ccw": "L", "up": "U", "down": "D"}
EASYCOMM_WAYS = {"cw": "MR", "ccw": "ML", "up": "MU", "down": "MD"}


def said(event: Event) -> bytes:
    """The bytes of an event of a link or a console; empty: this protocol has no words for it."""
    if event.what == "junk":
        return event.text(0).encode("latin-1") + b"\r\n"  # else the next order would be a part of it
    if event.who == PAGE or event.who.startswith("console"):
        return _line(_console(event), b"\n")
    match PROTOCOLS[event.who]:
        case "gs232a" | "gs232b":
            return _line(_gs232(event), b"\r")
        case "rotctld":
            return _line(_rotctld(event), b"\n")
        case "pstrotator":
            return _pstrotator(event).encode()
        case _:
            return _line(_easycomm(event), b"\n")


def _line(text: str, end: bytes) -> bytes:
    return text.encode() + end if text else b""


def _gs232(event: Event) -> str:
    match event.what, event.args:
        case "aim", (azimuth_deg, elevation_deg):
            # The command set has neither negative elevations nor decimals.
            return f"W{round(float(azimuth_deg)):03d} {max(0, round(float(elevation_deg))):03d}"
        case "aim-azimuth", (azimuth_deg,):
            return f"M{round(float(azimuth_deg)):03d}"
        case "jog", (way,):
            return GS232_WAYS[str(way)]
        case "stop", ():
            return "S"
        case "stop-axis", (axis,):
            return "A" if axis == "azimuth" else "E"
        case "list", (interval_s, *angles):
            return f"W{round(float(interval_s)):03d} " + " ".join(f"{round(float(each)):03d}" for each in angles)
        case "run-list", ():
            return "T"
        case "calibrate", (axis, end):
            return {"low": "O", "high": "F"}[str(end)] + ("2" if axis == "elevation" else "")
        case "speed", (level,):
            return f"X{round(float(level))}"
        case "ask", ():
            return "C2"
    return ""


def _rotctld(event: Event) -> str:
    match event.what, event.args:
        case "aim", (azimuth_deg, elevation_deg):
            return f"P {float(azimuth_deg):.2f} {float(elevation_deg):.2f}"
        case "jog", (way,):
            return f"M {ROTCTLD_WAYS[str(way)]} -1"
        case "stop", ():
            return "S"
        case "park", ():
            return "K"
        case "ask", ():
            return "p"
    return ""


def _easycomm(event: Event) -> str:
    match event.what, event.args:
        case "aim", (azimuth_deg, elevation_deg):
            return f"AZ{float(azimuth_deg):.1f} EL{float(elevation_deg):.1f}"
        case "aim-azimuth", (azimuth_deg,):
            return f"AZ{float(azimuth_deg):.1f}"
        case "aim-elevation", (elevation_deg,):
            return f"EL{float(elevation_deg):.1f}"
        case "jog", (way,):
            return EASYCOMM_WAYS[str(way)]
        case "stop", ():
            return "SA SE"
        case "stop-axis", (axis,):
            return "SA" if axis == "azimuth" else "SE"
        case "park", ():
            return "PARK"
        case "ask", ():
            return "AZ EL"
    return ""


def _pstrotator(event: Event) -> str:
    match event.what, event.args:
        case "aim", (azimuth_deg, elevation_deg):
            azimuth = f"<AZIMUTH>{float(azimuth_deg):.1f}</AZIMUTH>"
            return f"<PST>{azimuth}<ELEVATION>{float(elevation_deg):.1f}</ELEVATION></PST>"
        case "aim-azimuth", (azimuth_deg,):
            return f"<PST><AZIMUTH>{float(azimuth_deg):.1f}</AZIMUTH></PST>"
        case "stop", ():
            return "<PST><STOP>1</STOP></PST>"
        case "park", ():
            return "<PST><PARK>1</PARK></PST>"
        case "ask", ():
            return "<PST>AZ?</PST>"
    return ""


def _console(event: Event) -> str:
    match event.what, event.args:
        case "aim", (azimuth_deg, elevation_deg):
            return f"point {float(azimuth_deg):g} {float(elevation_deg):g}"
        case "jog", (way, seconds):
            return f"jog {way} {float(seconds):.3g}"
        case "stop" | "resume" | "let-go" | "take" | "give-back" as word, ():
            return word
        case "storm", ():
            return "park"
        case "home" | "relays-checked" | "hold" | "mode" as word, (what,):
            return f"{word} {what}"
        case "confirm", (axis, angle_deg):
            return f"confirm {axis} {float(angle_deg):.2f}"
        case "panel", (*words,):
            return "panel " + " ".join(f"{word:.3g}" if isinstance(word, float) else str(word) for word in words)
        case "track", (str(words),) if words.startswith(TABLE):
            rows = ["t,az,el", *words.removeprefix(TABLE).split(";")]
            return "\n".join(("table", *(f"table {row}" for row in rows), "track-table table"))
        case "track", (words,):
            return f"track {words}"
        case "ask", ():
            return "status"
    return ""
