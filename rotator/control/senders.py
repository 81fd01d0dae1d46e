"""Who has sent orders lately, which of them are streams, and whose orders have no effect at present.

Knows connections, moments, the directions that they asked for, and who silenced a connection. The stops and the switch
that hold back every connection are in `authority`. Knows no axis.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace

from rotator.control.sky.angles import Coordinates, great_circle_deg, turn_deg
from rotator.exchange.orders import Aim, Order
from rotator.exchange.sources import Source

PAUSE_S = 10.0
"""Orders further apart than this do not belong together. A silenced stream has an effect again after such a pause."""
SINGLE_PAUSE_S = 3.0
"""The pause after which a single order of a silenced connection counts: one that does not belong to a stream."""
STREAM_ORDERS = 4
"""From the fourth order on, each within PAUSE_S of the one before, a connection sends a stream."""
FIGHT_S = 60.0
FIGHT_TAKES = 3
"""After this many takes within FIGHT_S a new connection of the link does not end the silence: its program connects
again by itself."""


def aims_of(order: Order) -> Coordinates | None:
    """Where an order points; None: it is no order for a direction."""
    return (order.azimuth_deg, order.elevation_deg) if isinstance(order, Aim) and order.engaged else None


@dataclass(frozen=True, slots=True)
class _Sender:
    heard_s: float
    aims: Coordinates | None = None
    """Where its latest order points; None: it was no order for a direction."""
    in_a_row: int = 1
    own: int = 1
    """Its orders on this connection; the others of the row came on earlier connections of the link."""
    recurs: bool = False
    """Its connection has ended, and its program is one that connects anew by itself."""
    stopped_by: Source | None = None
    taken_by: Source | None = None
    """The source whose stop, or whose order for another direction, has silenced it; None: no such source."""

    @property
    def streams(self) -> bool:
        return self.in_a_row >= STREAM_ORDERS

    @property
    def silenced(self) -> bool:
        return self.stopped_by is not None or self.taken_by is not None

    @property
    def pause_s(self) -> float:
        """The pause after which it has an effect again."""
        return PAUSE_S if self.streams else SINGLE_PAUSE_S

    def heard(self, now_s: float, aims: Coordinates | None) -> _Sender:
        """The same sender after one more order."""
        sender = self.freed() if now_s - self.heard_s >= self.pause_s else self
        return replace(sender, heard_s=now_s, aims=aims, in_a_row=self.in_a_row + 1, own=self.own + 1)

    def freed(self) -> _Sender:
        return replace(self, stopped_by=None, taken_by=None)


class Senders:
    """Every order that would move an axis is noted here, whether it has an effect or not.

    `agree_deg`: two directions closer than this count as equal.
    """

    def __init__(self, agree_deg: float) -> None:
        self._agree_deg = agree_deg
        self._senders: dict[Source, _Sender] = {}
        self._gone: dict[str, _Sender] = {}
        """By link: the last connection that ended there, for a program that connects anew for each order."""
        self._takes_s: deque[float] = deque(maxlen=FIGHT_TAKES)

    def note(self, source: Source, now_s: float, aims: Coordinates | None) -> None:
        """`source` sends an order that points at `aims`; None: another order that moves an axis."""
        self._forget(now_s)
        known = self._senders.get(source)
        if known is None and (gone := self._gone.pop(source.link, None)) is not None:
            # What silenced a program that connects for every order silences its next connection.
            known = replace(gone if gone.streams and gone.recurs else gone.freed(), own=0, recurs=False)
        self._senders[source] = known.heard(now_s, aims) if known else _Sender(now_s, aims)

    def silence(self, source: Source) -> str:
        """Why the orders of `source` have no effect, and what ends that; empty: they have an effect."""
        if (sender := self._senders.get(source)) is None:
            return ""
        again = f"orders count again after a pause of {sender.pause_s:g} s"
        # Not where its program connects for every few orders: its next connection is no new beginning (`left`).
        anew = ", or on a new connection" if sender.own >= STREAM_ORDERS or not sender.streams else ""
        if (by := sender.taken_by) is not None:
            if (other := self._senders.get(by)) is not None and other.streams:
                return f"{by} moves the antenna, and both send directions: end one of the two programs ({again})"
            return f"{by} moves the antenna now; {again}{anew}"
        return f"{by} has stopped the antenna; {again}{anew}" if (by := sender.stopped_by) else ""

    def sends(self, source: Source, now_s: float) -> bool:
        """Whether an order of `source` came less than the pause of a stream ago."""
        sender = self._senders.get(source)
        return sender is not None and now_s - sender.heard_s < PAUSE_S

    def streams(self, source: Source) -> bool:
        """Whether `source` sends a stream on its present connection alone."""
        sender = self._senders.get(source)
        return sender is not None and sender.own >= STREAM_ORDERS

    def stop(self, source: Source, now_s: float) -> None:
        """Silence every other connection that has sent lately, until it pauses or connects again."""
        self._forget(now_s)
        self._senders = {
            each: sender.freed() if each == source else replace(sender.freed(), stopped_by=source)
            for each, sender in self._senders.items()
        }
        # A script that connects for every order may stop and go on: its own link's stop does not silence it.
        self._gone = {
            link: sender.freed() if link == source.link else replace(sender.freed(), stopped_by=source)
            for link, sender in self._gone.items()
        }

    def take(self, source: Source, now_s: float) -> None:
        """The latest order of `source` has an effect. Silence every stream that points elsewhere, until it pauses."""
        aims = self._senders[source].aims
        lost = [each for each, sender in self._senders.items() if each != source and self._loses(sender, aims)]
        gone = [link for link, sender in self._gone.items() if self._loses(sender, aims)]
        for other in lost:
            self._senders[other] = replace(self._senders[other], taken_by=source)
        for link in gone:
            self._gone[link] = replace(self._gone[link], taken_by=source)
        if lost or gone:
            self._takes_s.append(now_s)

    def free_all(self) -> None:
        """End the silence of all connections, and their fight."""
        self._senders = {source: sender.freed() for source, sender in self._senders.items()}
        self._gone.clear()
        self._takes_s.clear()

    def free_taken(self) -> None:
        """End the silence of connections that lost the antenna to an order. Those that a stop silenced stay silent."""
        self._senders = {source: replace(sender, taken_by=None) for source, sender in self._senders.items()}
        self._gone = {link: replace(sender, taken_by=None) for link, sender in self._gone.items()}
        self._takes_s.clear()

    def left(self, source: Source, now_s: float) -> None:
        """The connection has ended. The next one on its link continues the row of orders. It is not silenced, unless
        the program connects again for every few orders, or in a fight."""
        self._forget(now_s)
        if (sender := self._senders.pop(source, None)) is not None:
            recurs = sender.own < STREAM_ORDERS or self._fighting(now_s)
            self._gone[source.link] = replace(sender, recurs=recurs)

    def _loses(self, sender: _Sender, aims: Coordinates | None) -> bool:
        return sender.streams and not sender.silenced and not self._agree(sender.aims, aims)

    def _agree(self, one: Coordinates | None, other: Coordinates | None) -> bool:
        """Whether both orders can be met. An order without a direction, such as a jog, agrees with no other."""
        if one is None or other is None:
            return False
        (az_1, el_1), (az_2, el_2) = one, other
        if az_1 is not None and el_1 is not None and az_2 is not None and el_2 is not None:
            return great_circle_deg(az_1, el_1, az_2, el_2) <= self._agree_deg
        turned = az_1 is not None and az_2 is not None and abs(turn_deg(az_1, az_2)) > self._agree_deg
        raised = el_1 is not None and el_2 is not None and abs(el_1 - el_2) > self._agree_deg
        return not turned and not raised

    def _fighting(self, now_s: float) -> bool:
        return len(self._takes_s) == FIGHT_TAKES and now_s - self._takes_s[0] < FIGHT_S

    def _forget(self, now_s: float) -> None:
        self._senders = {each: sender for each, sender in self._senders.items() if now_s - sender.heard_s < PAUSE_S}
        self._gone = {link: sender for link, sender in self._gone.items() if now_s - sender.heard_s < PAUSE_S}
