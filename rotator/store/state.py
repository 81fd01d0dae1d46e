"""The one file of what the box remembers, `state.json`: whole or not at all, with one copy in the program.

Each thing that is remembered has a section. Knows which sections also have a place in memory, for a card that refuses
or hangs: there they outlive a killed program, not a boot. Memory never has an older section than the card. Knows too
that another program may write the file, and what an earlier version wrote into a file for each section. Does not know
what a section means.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from rotator.store.hanging import under_way
from rotator.store.json_file import Form, JsonFile, damage
from rotator.store.plain import read_plain
from rotator.store.whole import alone, remove_whole, write_whole

log = logging.getLogger(__name__)

T = TypeVar("T")
Content = Mapping[str, Any]
"""What the file says in one section, in the types of JSON. An empty one was lost: no section is content with it."""
Sections = Mapping[str, Content]
"""By the name of the section."""


def _first(content: dict[str, Any]) -> dict[str, Any]:
    """In its first form the file had what the motors taught, and nothing else."""
    return {"learnt": {"axes": content.get("axes")}}


FORM = Form("rotator state", (_first,))
EARLIER = {name: Form(f"rotator {name}") for name in ("latch", "relays", "tries", "knobs", "compass", "priorities")}
"""An earlier version of the program had a file for each of these, beside this one."""
SPARED = ("latch", "relays", "tries")
"""What must outlive a killed program on a card that refuses: these sections are in memory until the card has them."""
DAMAGED = ".damaged"
"""The ending of the name under which a damaged file is kept for a person."""
LOST: Content = {}


@dataclass(frozen=True, slots=True)
class Section(Generic[T]):
    """`parse` raises ValueError, KeyError, TypeError or AttributeError for damaged content. Then the value is
    `damaged`, and `consequence` says to a person what that means for the box."""

    name: str
    parse: Callable[[Any], T]
    content: Callable[[T], Content]
    absent: T
    damaged: T
    consequence: str


class State:
    """It reads the file at once. `memory`: a folder that outlives the program, and not a boot; None: there is none.

    May be used from any thread. `load` and `note` never wait for the card; `save` does. Failures go to the log, and
    nothing is raised. Who loads or notes a section answers for it: it stays when another program changes the file. All
    other sections are then taken from there.
    """

    def __init__(self, path: Path, memory: Path | None = None) -> None:
        self.path = path
        self.news = threading.Condition()
        """Told of each note. Held only for moments."""
        self._card = JsonFile(path, FORM, "what the box remembers")
        self._memory = JsonFile(memory / path.name, FORM, "what the box remembers") if memory else None
        self._writing, self._sparing = threading.Lock(), threading.Lock()
        """One thread at a time writes the card, and one memory."""
        self._own: set[str] = set()
        self._lasting: dict[str, Content] = {}
        """What the card is to have of a section where memory alone has more."""
        self._unremoved = ""
        self._earlier: list[Path] = []
        """The files of an earlier version, which are not removed yet: they count as long as they are there."""
        self._read()

    def _read(self) -> None:
        self._on_card = self._of_card("nothing in it is believed; nothing moves until resume")
        """What the card has; None: not known."""
        self._damaged = self._on_card is None
        newest = dict.fromkeys(SPARED, LOST) if self._on_card is None else dict(self._on_card)
        newest |= self._of_earlier(self.path.parent)
        self.in_memory = self._memory is not None and _may_exist(self._memory.path)
        """An earlier run in this boot left something newer than what is on the card."""
        self._memory_has: Sections | None = None
        """What the file in memory has; None: there is none."""
        if self._memory is not None and self.in_memory:
            self._memory_has = self._memory.load(
                _sections, absent={}, damaged=dict.fromkeys(SPARED, LOST), consequence="nothing in it is believed"
            )
            newest |= {name: content for name, content in self._memory_has.items() if name in SPARED}
        if self._memory is not None:
            newest |= self._of_earlier(self._memory.path.parent)
        self._newest: Sections = newest
        self._tried: Sections | None = self._on_card
        self._spare_tried: Sections | None = self._memory_has
        """What the card and memory were last asked to take."""

    def _of_card(self, consequence: str) -> Sections | None:
        """None: what is there cannot be used."""
        nothing: Sections = {}
        return self._card.load(_sections, absent=nothing, damaged=None, consequence=consequence)

    def _of_earlier(self, folder: Path) -> Sections:
        found = {}
        for name, form in EARLIER.items():
            path = folder / f"{name}.json"
            content = JsonFile(path, form, name).load(
                _sections, absent=None, damaged=LOST, consequence="nothing in it is believed"
            )
            if content is not None:
                found[name] = content
                self._earlier.append(path)
        return found

    @property
    def trouble(self) -> str:
        """Why the card refused the last change; empty: it did not."""
        return self._card.trouble or self._unremoved

    @property
    def later(self) -> str:
        """Why the file is not written: it belongs to a later version; empty: it is of this one."""
        return self._card.later

    @property
    def outlives(self) -> bool:
        """Whether the newest of what must outlive a killed program does: one of the two places has it."""
        return not self.trouble or (self._memory is not None and not self._memory.trouble and not self._unremoved)

    @property
    def sections(self) -> Sections:
        """The newest of all."""
        with self.news:
            return self._newest

    @property
    def unwritten(self) -> bool:
        """Whether there is something that the card was not yet asked to take."""
        with self.news:
            return self._for_card() != self._tried

    @property
    def unspared(self) -> bool:
        """Whether there is something that memory was not yet asked to take."""
        with self.news:
            return self._memory is not None and self._for_memory() != self._spare_tried

    def load(self, section: Section[T]) -> T:
        """The newest value of a section."""
        with self.news:
            self._own.add(section.name)
            content = self._newest.get(section.name)
        if content is None:
            return section.absent
        try:
            return section.parse(content)
        except (ValueError, KeyError, TypeError, AttributeError) as fault:
            log.warning("%s: %s: %s: %s", self.path, section.name, section.consequence, damage(fault))
            return section.damaged

    def note(self, section: Section[T], value: T, *, lasting: T | None = None) -> None:
        """This counts from now on. `lasting`: what the card is to have of it, where it changes too often for a card."""
        content = section.content(value)
        with self.news:
            self._own.add(section.name)
            self._newest = {**self._newest, section.name: content}
            self._lasting.pop(section.name, None)
            if lasting is not None:
                self._lasting[section.name] = section.content(lasting)
            self.news.notify_all()

    def keep(self, section: Section[T], value: T) -> bool:
        """Note it, and save. False: the card refuses; it is tried again with the next `save`."""
        self.note(section, value)
        return self.save()

    def save(self) -> bool:
        """Have the card take the newest, unless it has it. False: it refuses. While it hangs, memory has the newest."""
        with self._writing:
            newest = self.spare()
            if newest == self._on_card and not self._earlier and not self._card.changed:
                self._tried = newest
                return True
            with under_way(self.path), alone(self.path.parent):
                return self._save()

    def _save(self) -> bool:
        self._look()
        # The card never gets what memory does not have yet: else memory would hide it after a kill.
        newest = self.spare(writing=True)
        done = self._on_card is not None or self._write(newest)
        with self.news:
            self._on_card = dict(newest) if done else None
        self.spare()
        return done and self.forget_earlier()

    def spare(self, *, writing: bool = False) -> Sections:
        """Have memory take what the card has not; or remove it there, if the card has it all. Returns what the card may
        be given now. `writing`: it is given that next, unless it has it."""
        with self._sparing:
            with self.news:
                newest = self._for_card()
                if writing:
                    self._tried = newest
                    if newest != self._on_card:
                        # What a write leaves that hangs is not known: memory keeps the newest, whichever it is.
                        self._on_card = None
                wanted = self._for_memory()
            if self._memory is not None and wanted != self._memory_has:
                done = self._memory.save(wanted) if wanted is not None else _gone(self._memory.path)
                self._memory_has = wanted if done else {}
            self._spare_tried = wanted
        return newest

    def _for_card(self) -> Sections:
        return {**self._newest, **self._lasting}

    def _for_memory(self) -> Sections | None:
        if self._own.isdisjoint(SPARED):
            return self._memory_has  # who answers for none of it may have an old copy
        spared = {name: self._newest[name] for name in SPARED if name in self._newest}
        on_card = self._on_card
        if on_card is not None and all(on_card.get(name) == content for name, content in spared.items()):
            return None
        return spared or None

    def _look(self) -> None:
        """Take over what another program has written, but for the sections that are ours."""
        if not self._card.changed:
            return
        there = self.path.exists()
        found = self._of_card("written again") if there else None
        with self.news:
            self._on_card = found
            if found is not None:
                ours = {name: content for name, content in self._newest.items() if name in self._own}
                others = {name: content for name, content in found.items() if name not in self._own}
                self._newest = {**others, **ours}
        self._damaged = there and found is None

    def _write(self, newest: Sections) -> bool:
        if self._damaged and not self._card.later:
            self._set_aside()
        return self._card.save(newest)

    def _set_aside(self) -> None:
        self._damaged = False
        try:
            write_whole(self.path.with_name(self.path.name + DAMAGED), read_plain(self.path), like=self.path)
        except OSError as fault:
            log.warning("%s: damaged, and no copy of it can be kept: %s", self.path, fault)
        else:
            log.warning("%s: damaged; what was in it is kept in %s%s", self.path, self.path.name, DAMAGED)

    def forget_earlier(self) -> bool:
        """The file has it all: remove the files of the earlier version. False: one of them stays, and would count."""
        try:
            while self._earlier:
                remove_whole(self._earlier[-1])
                self._earlier.pop()
        except OSError as fault:
            if str(fault) != self._unremoved:
                log.error("%s: it is in %s now, and cannot be removed: %s", self._earlier[-1], self.path.name, fault)
            self._unremoved = str(fault)
            return False
        self._unremoved = ""
        return True


def _sections(content: dict[str, Any]) -> Any:
    return {name: each for name, each in content.items() if name != "format"}


def _may_exist(path: Path) -> bool:
    try:
        return path.exists()
    except OSError:
        return True  # a folder that this user may not read: its load says so, and believes nothing


def _gone(path: Path) -> bool:
    with suppress(OSError):
        path.unlink(missing_ok=True)
        return True
    return False
