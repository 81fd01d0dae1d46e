"""install.sh on the Pi's own architecture, emulated: Debian 12 and 13, from the sources to nothing again."""

from __future__ import annotations

from concurrent.futures import Future

import pytest

from tests.install.conftest import RELEASES
from tests.install.roots import Said
from tests.install.visit import WORST_EXPOSURE, Visit


@pytest.fixture(params=RELEASES)
def seen(request: pytest.FixtureRequest, arm64_visits: dict[str, Future[Visit]]) -> Visit:
    return arm64_visits[request.param].result()


def test_the_service_user_can_run_it(seen: Visit) -> None:
    assert seen.version.check().text.startswith("rotator ")


def test_compiled_packages_are_this_machines(seen: Visit) -> None:
    assert seen.compiled == Said(0, "")


def test_the_unit_is_sound_and_shut_in(seen: Visit) -> None:
    assert seen.verified == Said(0, "")
    assert seen.exposure <= WORST_EXPOSURE


def test_a_second_run_changes_nothing(seen: Visit) -> None:
    assert seen.second_run.check().text.startswith("Nothing to do")
    assert seen.changed_by_second_run == set()


def test_removed_nothing_is_left(seen: Visit) -> None:
    assert seen.left == set()
