"""What every test may lean on: foreign programs that skip where they are missing, and a leak watch."""

from __future__ import annotations

import asyncio
import gc
import inspect
import os
import resource
import shutil
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractAsyncContextManager, AsyncExitStack
from pathlib import Path

import pytest

from rotator.rehearsal.passes import SHIPPED
from tests.search import examples

PASSES = sorted(SHIPPED.glob("*.csv"))
collect_ignore = [] if "GS232_KERNEL" in os.environ else ["kernel"]
"""Tests that need a kernel of their own run in it: `make test-kernel`."""

SLOW = (
    *("page", "machines", "rotors", "flights", "calibrating/test_north.py", "cli/test_calibrate_north.py"),
    *("foreign/test_hamlib.py", "foreign/test_rotctld_follow.py", "foreign/clients", "foreign"),
    *("cli", "scenario/test_small_machine.py"),
    *("release/test_archives.py", "release/test_package.py", "release/test_wheel.py"),
)
"""Tests of minutes, run only where they are named: `make test-rotors` has every kind of rotor, all its faults and whole
passes; `make test-machines` has the five machines in real time; `make test-page` the page in Chromium; `make
test-terminal` the commands as a person types them, and a small computer; `make test-hamlib` other programs of Debian
and every model of Hamlib that can drive the box, at Hamlib's own pace; `make test-clients` the newest Hamlib and other
people's tracking programs; `make test-dist` builds what is handed out and tries it on three Pythons. What lies in a
folder named here, and is named itself, has to be asked for by its own name."""
URGENT_US = 500_000
"""LimitRTTIME of install/rotator.service."""
SLOW_PATHS = [str(Path(__file__).parent / name) for name in SLOW]


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    path = f"{collection_path}/"
    slow = next((each for each in SLOW_PATHS if path.startswith(f"{each}/")), None)
    if slow is None:
        return None
    named = [Path(argument.split("::")[0]).resolve() for argument in config.args]
    return None if any(name.is_relative_to(slow) for name in named) else True


def pytest_configure(config: pytest.Config) -> None:
    """An example may take as long as a busy machine needs, also to be drawn: what must be fast is measured, not guessed
    from one run.

    A search that names no number of its own tries a hundred in `make test-search`.

    A box under test goes before what runs beside it, where the system lets it, as the service's unit has it do.

    A shell starts what runs in its background deaf to Ctrl-C, `nohup` deaf to a closed terminal, and the programs under
    test would inherit that. A signal that is handled here is not: they begin with its default.
    """
    resource.setrlimit(resource.RLIMIT_RTTIME, (URGENT_US, resource.getrlimit(resource.RLIMIT_RTTIME)[1]))
    for key in (signal.SIGINT, signal.SIGQUIT):
        if signal.getsignal(key) is signal.SIG_IGN:
            signal.signal(key, signal.default_int_handler)
    if signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
        signal.signal(signal.SIGHUP, lambda _number, _frame: None)
    if config.pluginmanager.hasplugin("hypothesispytest"):
        from hypothesis import HealthCheck, settings

        present = settings.get_profile(settings.get_current_profile_name())
        patient = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow]}
        settings.register_profile("house", present, max_examples=examples(present.max_examples), **patient)
        settings.load_profile("house")


def pytest_collection_finish() -> None:
    """Thousands of tests stay in memory to the end: the garbage collector does not look at them again and again."""
    gc.collect()
    gc.freeze()


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """An `async def` test has an event loop of its own. A fixture that is an asynchronous context is entered there."""
    if not inspect.iscoroutinefunction(pyfuncitem.obj):
        return None

    async def run() -> None:
        async with AsyncExitStack() as entered:
            values = {name: pyfuncitem.funcargs[name] for name in inspect.signature(pyfuncitem.obj).parameters}
            for name, value in values.items():
                if isinstance(value, AbstractAsyncContextManager):
                    values[name] = await entered.enter_async_context(value)
            await pyfuncitem.obj(**values)

    asyncio.run(run())
    return True


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("hardware", "tests/contract on a Raspberry Pi")
    group.addoption("--hardware", action="store_true", help="run tests/contract on this machine's pins and I2C bus")
    group.addoption("--hardware-config", metavar="FILE", help="the rotator.toml with the pins and addresses")
    group.addoption("--motors-are-unplugged", action="store_true", help="relays may close")
    group = parser.getgroup("machines", "tests/machines: the five machines in real time")
    group.addoption("--times", type=int, help="days of each machine")
    group.addoption("--seed", type=int, help="seed of the first day")


@pytest.fixture(scope="session", autouse=True)
def _boxes_of_its_own(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """A box under test is not found by another person's `rotator stop`, nor does a test stop another person's box."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        yield


@pytest.fixture
def need_program() -> Callable[[str, str], str]:
    """The path of a foreign program; where it is missing the test skips, and on the build machine it fails."""

    def need(program: str, package: str) -> str:
        path = shutil.which(program)
        if path is None:
            reason = f"{program} is missing: sudo apt install {package}"
            if os.environ.get("CI") == "true":
                pytest.fail(reason)
            pytest.skip(reason)
        return path

    return need


@pytest.fixture(autouse=True)
def no_thread_left_behind() -> Iterator[None]:
    """A test that leaves a control thread, a guard or a display running has not stopped what it started."""
    before = set(threading.enumerate())
    yield
    left = [t.name for t in threading.enumerate() if t not in before and not t.name.startswith(("asyncio_", "Thread-"))]
    for thread in threading.enumerate():
        if thread not in before and thread.name in left:
            thread.join(timeout=2.0)
    left = [t.name for t in threading.enumerate() if t not in before and t.name in left]
    assert not left, f"threads left behind: {left}"
