"""Opens a front panel as its table describes it: its share of the composition root.

Knows the drivers and the wiring. The panel knows the meaning of a switch. Decides nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial

from hw.chips.ads1115 import Ads1115
from hw.chips.pca9685 import Pca9685
from hw.ports import AngleSensor, Axis
from hw.sensors.pot import PotSensor, Reference
from rotator.assembly.buses import Board
from rotator.config.model import Config
from rotator.exchange.orders import Order
from rotator.exchange.status import Status
from rotator.panel.inputs import KnobWiring
from rotator.panel.lights import LightWiring
from rotator.panel.panel import Panel, PanelSettings
from rotator.panel.thread import PanelParts, PanelThread
from rotator.store.learnt import KNOBS
from rotator.store.state import State

LAMP_TEST_S = 1.0
METER_HZ = 1000.0
"""The frequency of the meters' outputs: fast enough that a needle does not tremble."""


def panel_parts(config: Config, board: Board) -> PanelParts:
    """The panel's own chips and lines. Raises HardwareError where a line cannot be taken."""
    table = config.panel
    switches = board.inputs("rotator-panel", table.switches) if table.switches else None
    outputs = None
    if table.uses_outputs:
        bus = board.bus(table.outputs_bus)
        outputs = Pca9685(bus, table.outputs_address, board.sleep, frequency_hz=METER_HZ)
    return PanelParts(
        switches=switches,
        has_stop=table.stop is not None,
        sensors=_inputs(config, board),
        outputs=outputs,
        lights=LightWiring(
            lamps=table.lamps,
            meters={Axis(name): output for name, output in table.meters.items()},
            meter_full_scale=table.meter_full_scale,
        ),
    )


def _inputs(config: Config, board: Board) -> dict[str, AngleSensor]:
    table = config.panel
    if not table.uses_adc:
        return {}
    # The panel has a converter of its own: two threads on one would read each other's channel.
    adc = Ads1115(board.bus(table.adc_bus), table.adc_address, board.sleep)
    supply = table.supply_v if table.reference is None else Reference(adc, table.reference, board.clock)
    return {name: PotSensor(adc, channel, supply) for name, channel in table.inputs.items()}


def panel_thread(
    config: Config,
    parts: PanelParts,
    status: Callable[[], Status],
    post: Callable[[Order], None],
    clock: Callable[[], float],
    *,
    state: State | None = None,
    pulses: Callable[[], Iterable[Axis]] = lambda: (),
    failed: Callable[[Exception], None] = lambda failure: None,
) -> PanelThread:
    """The panel, ready to be started. `state`: it remembers the knobs' full scales; None: they are not kept."""
    table = config.panel
    nudge_deg = {Axis.AZIMUTH: table.azimuth_nudge_deg, Axis.ELEVATION: table.elevation_nudge_deg}
    wiring = KnobWiring(table.knob_lowest_reading, table.knob_highest_reading, table.knob_zero)
    panel = Panel(
        PanelSettings(table.has_mode_switch, nudge_deg, wiring, LAMP_TEST_S), state.load(KNOBS) if state else {}
    )
    keep = partial(state.keep, KNOBS) if state else lambda _full_scales: True
    return PanelThread(panel, parts, status, post, clock, keep=keep, pulses=pulses, failed=failed)
