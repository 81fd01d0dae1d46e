"""install.sh and the Debian package on the Pi's own architecture, emulated.

Debian 12 has Python 3.11, Debian 13 has 3.13: the same package serves both. install.sh is tried on the newer one; on
Debian 12 the other tests try it, without emulation.
"""

from __future__ import annotations

from concurrent.futures import Future

import pytest

from tests.install.conftest import RELEASES
from tests.install.roots import Said
from tests.install.visit import Visit


@pytest.mark.parametrize("release", RELEASES)
def test_it_works_as_the_service_user_and_its_compiled_packages_are_this_machines(
    release: str, arm64_visits: dict[str, Future[list[Visit]]]
) -> None:
    for seen in arm64_visits[release].result():
        assert seen.version.check().text.startswith("rotator ")
        assert seen.compiled == Said(0, "")
