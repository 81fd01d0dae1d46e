"""The questions of `rotator config --ask` all at once, for a form, and the file that comes of the answers.

Knows what of the old file belongs to the box and not to its rotor, and stays. Does not know the form.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path
from typing import Any

from rotator.config.edit import Change, NoChangeError, edited
from rotator.config.model import Config
from rotator.config.places import INSTALLED
from rotator.exchange.foreign import toml_of
from rotator.setup.machine import Machine, this_machine
from rotator.setup.new_file import for_the_service, new_file
from rotator.setup.question import Question
from rotator.setup.questions import questions

THE_BOX = ("page", "state", "monitor", "sim")
"""Tables that say where the box itself is and keeps its files: another rotor changes nothing of them."""
LONGEST = 200


@dataclass(frozen=True, slots=True)
class Asked:
    question: Question
    answer: str
    """As it was given, else the offered one."""
    mistake: str = ""
    """Why it is no answer; empty: it is one."""


def asked(answers: Mapping[str, object], machine: Machine) -> list[Asked]:
    """All questions that these answers lead to. What has no answer yet has the one that is offered."""
    taken: dict[str, str] = {}
    found: list[Asked] = []
    while question := next((each for each in questions(taken, machine) if each.name not in taken), None):
        question_asked = _asked(question, answers.get(question.name))
        found.append(question_asked)
        taken[question.name] = question.default if question_asked.mistake else question_asked.answer
    return found


def as_they_stand(config: Config) -> dict[str, str]:
    """The answers that the file gives by itself."""
    station = config.station
    place = station.locator or ""
    if station.latitude_deg is not None and station.longitude_deg is not None:
        place = f"{station.latitude_deg:g} {station.longitude_deg:g}"
    return {"hardware": config.rotor.hardware, "place": place}


def fresh(text: str, answers: Mapping[str, object], path: Path, today: date, machine: Machine | None = None) -> str:
    """A new text for the file at `path` in place of `text`. Raises NoChangeError for an answer that is none."""
    found = asked(answers, machine or this_machine())
    if wrong := next((each for each in found if each.mistake), None):
        raise NoChangeError(f"{wrong.question.text} {wrong.mistake}")
    new = new_file({each.question.name: each.answer for each in found})
    new = f"# Written by the page on {today.isoformat()}.\n{new}"
    new = for_the_service(new) if path == INSTALLED else new
    return edited(new, [change for name in THE_BOX for change in _kept((name,), toml_of(text).get(name, {}))])


def _kept(place: tuple[str, ...], value: Any) -> list[Change]:
    if not isinstance(value, dict):
        return [Change(place, value)]
    return [change for key, inner in value.items() for change in _kept((*place, key), inner)]


def _asked(question: Question, answer: object) -> Asked:
    if not isinstance(answer, str) or len(answer) > LONGEST:
        return Asked(question, question.default)
    if any(choice.answer == answer for choice in question.choices):
        return Asked(question, answer)
    try:
        return Asked(replace(question, default=""), question.answer(answer) if answer.strip() else question.default)
    except ValueError as reason:
        return Asked(question, answer, str(reason))
