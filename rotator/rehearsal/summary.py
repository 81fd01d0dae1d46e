"""What a rehearsed pass comes to: the pointing error, the work of relays and motors, and the faults at the end.

Knows the samples of a trace. Does not know how the antenna was pointed.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from rotator.rehearsal.overhearing import Named
from rotator.views.trace import Sample, errors_deg, p95, rms

SAMPLE_S = 0.05
"""The time between two samples of a trace."""


@dataclass(frozen=True, slots=True)
class Summary:
    """Great-circle error between target and antenna while the satellite is up, and the work of relays and motors."""

    rms_deg: float
    p95_deg: float
    max_deg: float
    relay_starts: int | None
    motor_s: float
    recognised: Named | None = None
    """The satellite that the box has recognised in the stream; None: none."""
    faults: tuple[str, ...] = ()
    """The faults that hold an axis at the end, each in a sentence."""

    def as_dict(self) -> dict[str, object]:
        return _rounded(asdict(self))


def summarise(trace: list[Sample], relay_starts: int | None) -> Summary:
    """The errors that count; the motors' time over the whole trace."""
    errors = errors_deg(trace) or [0.0]
    return Summary(
        rms_deg=rms(errors),
        p95_deg=p95(errors),
        max_deg=errors[-1],
        relay_starts=relay_starts,
        motor_s=sum(abs(sample.az_drive) + abs(sample.el_drive) for sample in trace) * SAMPLE_S,
    )


def _rounded(values: dict[str, Any]) -> dict[str, object]:
    return {
        key: _rounded(value) if isinstance(value, dict) else round(value, 3) if isinstance(value, float) else value
        for key, value in values.items()
    }
