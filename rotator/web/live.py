"""The live connection of a browser: ten pictures of the box a second, and the button that a person holds.

A slow reader gets the newest picture and no queue; a reader that takes no picture is dropped. A motor turns only while
fresh signs of the finger arrive. Each sign names the latest picture that the browser has seen: so the box knows its age
without the browser's clock, and ignores a sign that was stuck in the network. Does not know the content of a picture.
The caller decides who may give orders.
"""

from __future__ import annotations

import asyncio
import json
import logging
import re
from collections import Counter, deque
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from secrets import randbits
from typing import Any

from aiohttp import WSMsgType, web

from hw.ports import Axis, Direction
from rotator.exchange.foreign import json_of
from rotator.exchange.orders import Jog
from rotator.protocols.damaged import is_stop
from rotator.protocols.panel_words import TURNS

LEASE_S = 0.45
"""Seconds after the sending of a picture in which a sign that names it lets a motor turn."""

NUMBER_BITS = 53
"""A number of JavaScript holds as many without rounding."""


class Pictures:
    """The times at which the latest pictures were sent, by number. Numbers are drawn by lot: who has not seen a picture
    cannot name it."""

    def __init__(self) -> None:
        self._sent: deque[tuple[int, float]] = deque()

    def next(self, now_s: float) -> int:
        """The number of a picture that is sent now."""
        number = randbits(NUMBER_BITS)
        # Removed by age: many new browsers, each with a first picture, must not push out pictures that still count.
        while self._sent and now_s - self._sent[0][1] > LEASE_S:
            self._sent.popleft()
        self._sent.append((number, now_s))
        return number

    def sent_s(self, number: int) -> float | None:
        """When this picture was sent. None: too old, or never sent."""
        return next((at_s for each, at_s in self._sent if each == number), None)


class Holding:
    """One browser's button. `order` hands a jog to the box and returns why not."""

    def __init__(self, pictures: Pictures, order: Callable[[Jog], str]) -> None:
        self._pictures = pictures
        self._order = order
        self._held: tuple[Axis, Direction] | None = None
        self._press = 0
        self._until_s = 0.0

    def sign(self, turn: str, press: int, picture: int, now_s: float) -> str:
        """The button is held. `press`: counts the presses. Returns why nothing turns; empty: it turns."""
        sent_s = self._pictures.sent_s(picture)
        until_s = 0.0 if sent_s is None else sent_s + LEASE_S
        if until_s <= now_s:
            return "the connection is too slow to turn the antenna by hand"
        if press < self._press or (press == self._press and now_s >= self._until_s):
            return "the connection was lost for a moment: press again"
        way = TURNS[turn]
        if self._held is not None and self._held != way:
            self._release()
        if refused := self._order(Jog(*way, round(until_s - now_s, 3), held=True)):
            self._press, self._until_s, self._held = press, now_s, None
            return refused
        self._press, self._until_s, self._held = press, until_s, way
        return ""

    def let_go(self) -> None:
        """The button was released, or the browser has gone."""
        if self._held is not None:
            self._release()
        self._until_s = 0.0

    def _release(self) -> None:
        assert self._held is not None, "something is held"
        axis, _ = self._held
        self._held = None
        self._order(Jog(axis, Direction.OFF, held=True))


log = logging.getLogger(__name__)

EVERY_S = 0.1
TAKES_S = 5.0
"""Seconds: a browser that needs longer to take a picture is dropped."""
LONGEST_SIGN = 4096
"""Many more bytes than any of them needs: a longer one ends the connection unread, and it may be a damaged stop."""
_NO_STOP = re.compile(rb'"stop"\s*:\s*(?:false|null)')
MOST_SIGNS_PER_S = 40
MOST_WATCHERS = 80
Answer = dict[str, str | int]
USAGE = "that is none of the texts that /api/ names under /api/live"
MESSAGES = f"""The box sends ten times a second:

    {{"n": 1234, "now": {{…}}}}

`n` is the number of the picture, `now` is a `picture`. The first message has `hello` too, which is what /api/me
answers, and in it `box`, which is what /api/box answers:

    {{"hello": {{…}}, "n": 1233, "now": {{…}}}}

You may send, each as a text, {MOST_SIGNS_PER_S} a second:

    {{"stop": true}}

stops everything, and needs no pairing. With a `key` that another stop had, sent here or as `Idempotency-Key` of
/api/stop, it is the same press, which has stopped already. This needs a pairing:

    {{"hold": "cw", "press": 1, "n": 1234}}

A motor turns (cw, ccw, up or down) while you send this every 0.1 s. `press` counts your presses: one more each time.
`n` is the picture that you have seen last: where it is older than {LEASE_S:g} s, nothing turns.

    {{"let_go": true}}

The button is held no more. The end of the WebSocket says the same. What is not done the box answers; with the press,
where it concerns one:

    {{"refused": "the connection is too slow to turn the antenna by hand", "press": 1}}
"""


@contextmanager
def dropped_if_slow(socket: web.WebSocketResponse) -> Iterator[None]:
    """While messages are sent within this context, a timeout or a lost connection ends the transport.

    The task that reads from the browser ends with the transport.
    """
    try:
        yield
    except (TimeoutError, ConnectionError, RuntimeError):
        if (transport := socket.get_extra_info("transport")) is not None:
            transport.abort()


class Live:
    """`picture` makes the present picture, once for all browsers. `clock` gives seconds."""

    def __init__(
        self, picture: Callable[[], Mapping[str, Any]], note: Callable[[], None], clock: Callable[[], float]
    ) -> None:
        self.pictures = Pictures()
        self._picture = picture
        self._note = note
        self._clock = clock
        self._text = ""
        self._new = asyncio.Event()
        self._watchers: dict[web.WebSocketResponse, str] = {}
        """The connections, each with its machine; the oldest first."""

    def __len__(self) -> int:
        return len(self._watchers)

    async def run(self) -> None:
        """Make pictures until cancelled. Without a browser, only add a point to the past once a second."""
        noted_s, failed = 0.0, False
        while True:
            now_s = self._clock()
            try:
                if now_s - noted_s >= 1.0:
                    noted_s = now_s
                    self._note()
                if self._watchers:
                    self._text = self._made(now_s)
                    new, self._new = self._new, asyncio.Event()
                    new.set()
                failed = False
            except Exception:
                # The next one may be good again. A browser without pictures shows that itself.
                if not failed:
                    log.exception("page: a picture cannot be made")
                failed = True
            await asyncio.sleep(EVERY_S)

    async def serve(
        self,
        socket: web.WebSocketResponse,
        hello: dict[str, Any],
        holding: Holding | None,
        may_look: Callable[[], bool],
        *,
        stop: Callable[[str], str],
        host: str,
    ) -> None:
        """Serve until the browser leaves or loses its right to look. `holding` None: it may only look.

        `stop` stops everything, once for a key; every browser may call it. `host`: the browser's machine.
        """
        if len(self._watchers) >= MOST_WATCHERS:
            # As in `connections`: the oldest of the machine with the most.
            most, _ = Counter(self._watchers.values()).most_common(1)[0]
            oldest = next(one for one, theirs in self._watchers.items() if theirs == most)
            del self._watchers[oldest]
            await oldest.close(code=1013, message=b"another browser needed the place")
        self._watchers[socket] = host
        sender = asyncio.create_task(self._send(socket, hello, may_look), name="page: live")
        try:
            await self._listen(socket, holding, stop)
        finally:
            if holding is not None:
                holding.let_go()
            sender.cancel()
            await asyncio.gather(sender, return_exceptions=True)
            self._watchers.pop(socket, None)

    async def _send(self, socket: web.WebSocketResponse, hello: dict[str, Any], may_look: Callable[[], bool]) -> None:
        with dropped_if_slow(socket):
            async with asyncio.timeout(TAKES_S):
                await socket.send_str(json.dumps({"hello": hello} | json_of(self._made(self._clock()))))
            while not socket.closed:
                await self._new.wait()
                if not may_look():
                    await socket.close()
                    return
                async with asyncio.timeout(TAKES_S):
                    await socket.send_str(self._text)

    def _made(self, now_s: float) -> str:
        return json.dumps({"n": self.pictures.next(now_s), "now": self._picture()}, separators=(",", ":"))

    async def _listen(self, socket: web.WebSocketResponse, holding: Holding | None, stop: Callable[[str], str]) -> None:
        second, signs = 0, 0
        async for message in socket:
            if message.type not in (WSMsgType.TEXT, WSMsgType.BINARY):
                return
            said = message.data if isinstance(message.data, bytes) else message.data.encode()
            now_s = self._clock()
            second, signs = (second, signs + 1) if int(now_s) == second else (int(now_s), 1)
            if is_stop(said) and not _NO_STOP.search(said):
                answer: Answer = {"refused": stop(_key(said))}
            elif signs > MOST_SIGNS_PER_S:
                return
            else:
                answer = _act(said, holding, now_s)
            if answer["refused"]:
                await socket.send_str(json.dumps(answer))


def _key(text: bytes) -> str:
    """The key of a stop; empty: it has none, or the message is damaged."""
    try:
        sign = json_of(text)
    except ValueError:
        return ""
    match sign:
        case {"key": str() as key}:
            return key
        case _:
            return ""


def _act(text: bytes, holding: Holding | None, now_s: float) -> Answer:
    """Carry out a message. Returns the number of the press and why it was refused; empty: done."""
    try:
        sign = json_of(text)
    except ValueError:
        return {"refused": "that is no JSON"}
    match sign:
        case {"let_go": True}:
            if holding is not None:
                holding.let_go()
            return {"refused": ""}
        case {"hold": str() as turn, "press": int() as press, "n": int() as picture} if turn in TURNS:
            refused = holding.sign(turn, press, picture, now_s) if holding else "this browser is not paired"
            return {"refused": refused, "press": press}
        case _:
            return {"refused": USAGE}
