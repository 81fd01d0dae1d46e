"""install.sh and the Debian package on the Pi's own architecture, emulated: on Debian 12 and 13, and away again.

Debian 12 has Python 3.11, Debian 13 has 3.13: the same package serves both.
"""

from __future__ import annotations

from concurrent.futures import Future

import pytest

from tests.install.conftest import RELEASES, Visits
from tests.install.roots import Said
from tests.install.visit import THE_GROUPS, WORST_EXPOSURE, DebVisit, Visit


@pytest.fixture(params=RELEASES)
def both(request: pytest.FixtureRequest, arm64_visits: dict[str, Future[Visits]]) -> Visits:
    return arm64_visits[request.param].result()


@pytest.fixture
def seen(both: Visits) -> Visit:
    return both[0]


@pytest.fixture
def deb(both: Visits) -> DebVisit:
    return both[1]


def test_the_service_user_can_run_it(seen: Visit) -> None:
    assert seen.version.check().text.startswith("rotator ")


def test_compiled_packages_are_this_machines(seen: Visit) -> None:
    assert seen.compiled == Said(0, "")


def test_the_package_works_as_the_service_user(deb: DebVisit) -> None:
    assert deb.version.check().text.startswith("rotator ")
    assert deb.compiled == Said(0, "")
    assert deb.verified == Said(0, "")
    assert deb.exposure <= WORST_EXPOSURE


def test_the_package_purged_leaves_nothing_but_the_groups(deb: DebVisit) -> None:
    assert deb.left == THE_GROUPS
