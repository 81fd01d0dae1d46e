"""One contract on three benches: simulated chips, the kernel's drivers in `make test-kernel`, a Pi with --hardware."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from rotator.config.load import ConfigError, load
from rotator.config.model import Config
from tests.contract.bench import Bench


@pytest.fixture
def bench(request: pytest.FixtureRequest) -> Iterator[Bench]:
    bench = _bench(request.config)
    yield bench
    bench.release()
    bench.close()


def _wiring(options: pytest.Config) -> Config:
    file = options.getoption("--hardware-config")
    if file is None:
        pytest.exit("--hardware needs --hardware-config FILE, the rotator.toml with the pins and addresses", 2)
    if shutil.which("pinctrl") is None:
        pytest.exit("--hardware needs pinctrl, which Raspberry Pi OS has: sudo apt install raspi-utils", 2)
    try:
        return load(Path(file))
    except ConfigError as fault:
        pytest.exit(str(fault), 2)


def _bench(options: pytest.Config) -> Bench:
    if options.getoption("--hardware"):
        from tests.contract.raspberry_pi import RaspberryPiBench

        return RaspberryPiBench(_wiring(options), motors_are_unplugged=options.getoption("--motors-are-unplugged"))
    if "GS232_KERNEL" in os.environ:
        from tests.kernel.bench.contract import KernelBench

        return KernelBench()
    from tests.contract.simulated import SimulatedBench

    return SimulatedBench()
