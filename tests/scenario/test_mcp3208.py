"""An MCP3208 reads the pots: the whole box points by it, on any GPIO lines and on the kernel's SPI."""

from __future__ import annotations

import pytest

from rotator.config.load import ConfigError, parse
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from tests.scenario.sensed_box import Box

LINES = '[adc]\nkind = "mcp3208"\nazimuth_channel = 6\nelevation_channel = 7\n'
KERNEL = LINES + 'spi = "kernel"\n'


@pytest.mark.parametrize("text", [LINES, KERNEL], ids=["lines", "kernel"])
def test_it_points_where_it_is_sent(text: str) -> None:
    box = Box(text)
    box.loop.post(Source("test"), Aim(80.0, 45.0))
    box.wait(15.0)
    assert box.world.antenna() == pytest.approx((80.0, 45.0), abs=2.0)
    status = box.loop.status
    assert status.azimuth.fault is None
    assert status.azimuth.raw == pytest.approx(0.05 + 0.9 * 80.0 / 450.0, abs=0.01)


@pytest.mark.parametrize(
    ("text", "name"), [(LINES, "sensor silent"), (KERNEL, "pot open or shorted")], ids=["lines", "kernel"]
)
def test_a_converter_that_goes_stops_the_motors(text: str, name: str) -> None:
    box = Box(text)
    box.loop.post(Source("test"), Aim(200.0, 90.0))
    box.wait(2.0)
    assert box.world.drives() == (1, 1)
    box.world.inject("adc-gone")
    box.wait(1.0)
    assert box.world.drives() == (0, 0)
    for axis in (box.loop.status.azimuth, box.loop.status.elevation):
        assert axis.fault is not None
        assert axis.fault.name == name


def test_beside_digital_pots_it_shares_the_kernels_wires() -> None:
    digipot = '[rotor]\ntype = "digipot"\n[azimuth.sensor]\nkind = "pot"\n[digipot]\nspi = "kernel"\n'
    config = parse(digipot + 'elevation.select = 26\n[adc]\nkind = "mcp3208"\nspi = "kernel"\nselect = 7\n', "box")
    assert [pin for pin, _ in config.pins()].count(11) == 1
    with pytest.raises(ConfigError, match=r"GPIO 8 is used by digipot.azimuth.select and adc.select"):
        parse(digipot + '[adc]\nkind = "mcp3208"\nspi = "kernel"\n', "box")
