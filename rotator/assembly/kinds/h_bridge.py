"""Builds the kind h-bridge: two DC motors behind H-bridges with an encoder each, real or simulated.

Part of the composition root: names drivers and simulated parts, and passes them the keys of [bridge]. Decides nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from firmware_sim.rotors.h_bridge import BridgeAxisSpec, SimBridgeRotor
from hw.buses.gpio import GpioPair
from hw.buses.pwm import Files, KernelFiles, KernelPwm
from hw.buses.spi import SpiBus
from hw.chips.ls7366r import Ls7366r
from hw.drives.bridge import Bridge
from hw.drives.bridge_axis import BridgeAxis, BridgeSpec
from hw.drives.bridge_homing import BridgeEnd
from hw.drives.h_bridge import BridgedMotor, BridgeDrive
from hw.ports import Axis, Direction, OutputLines, SwitchInputs
from hw.sensors.chip_count import ChipCounter
from hw.sensors.quadrature import EncoderCounter, QuadratureCounter
from rotator.assembly.rotors import Assembly
from rotator.assembly.simulated_axes import STOP_BEYOND_DEG, SimulatedAxes
from rotator.config.chips import KERNEL_SELECTS
from rotator.rotors.bridges import BridgeRotor
from rotator.rotors.counted import CountedAxis
from rotator.store.counts import Place, Standing

FINEST_DEG = 0.02
"""An axis that must come nearer to its place than this hunts about it for ever: friction lets it go too far."""


def build(parts: Assembly, lines: OutputLines | None) -> BridgeRotor:
    assert lines is not None, "a bridge has lines for its directions"
    config, clock, world = parts.config, parts.board.clock, parts.board.world
    files: Files = world.pwm if isinstance(world, SimBridgeRotor) else KernelFiles()
    counts_writer, kept = parts.kept_counts(config.fitted)
    master = config.bridge.enable is not None
    axes: dict[Axis, CountedAxis] = {}
    motors: dict[Axis, BridgedMotor] = {}
    spi = [parts.board.spi(use) for use in config.kind.spi_uses()]
    for axis in config.fitted:
        counter = _counter(parts, axis, spi)
        axes[axis] = CountedAxis(axis, counter, counts_writer, clock)
        axes[axis].begin(_kept(counter, kept[axis]))
        bridge = _bridge(parts, axis, lines, files)
        end = _end(parts, axis, axes[axis].place)
        motors[axis] = BridgedMotor(BridgeAxis(_spec(parts, axis)), bridge, counter, axes[axis].start, end)
        counter.fed, counter.way = partial(_fed, bridge), partial(_way, bridge)
    drive = BridgeDrive(motors, clock, enable=lines if master else None, watch=parts.watch)
    sensors = parts.sensors(axes)
    return BridgeRotor(drive, sensors, axes, parts.shift, parts.ends, counts_writer=counts_writer, master=master)


def _fed(bridge: Bridge) -> tuple[bool, float]:
    return bridge.fed, bridge.off_s


def _way(bridge: Bridge) -> Direction:
    return bridge.last or Direction.PLUS


def _end(parts: Assembly, axis: Axis, place: Callable[[float], None]) -> BridgeEnd | None:
    table, limits = parts.config.bridge.of(axis), parts.config.axis(axis)
    if table.home == "none":
        return None
    shows = partial(_at_switch, parts, axis)
    if table.index is not None:
        shows = partial(_at_index, parts.board.inputs(f"rotator-{axis.value}-index", {"index": table.index}))
    span_deg = limits.max_deg - min(limits.min_deg, table.home_deg)
    return BridgeEnd(shows, table.home_deg, min(table.home_dps, limits.speed_dps), span_deg, place)


def _at_switch(parts: Assembly, axis: Axis) -> bool:
    return Direction.MINUS in parts.ends(axis)


def _at_index(inputs: SwitchInputs) -> bool:
    return inputs.read()["index"]


def _kept(counter: EncoderCounter, kept: Place) -> Place:
    """Where the axis stands: as its chip has counted on, where the file knows the same scale; else as the file says."""
    counted_on = kept.standing is Standing.KNOWN or kept.mid_move
    if isinstance(counter, ChipCounter) and counter.kept_deg is not None and counted_on:
        return Place(Standing.KNOWN, counter.kept_deg)
    return kept


def _counter(parts: Assembly, axis: Axis, spi: Sequence[SpiBus]) -> EncoderCounter:
    board, tables = parts.board, parts.config.bridge
    table = tables.of(axis)
    if table.counter == "ls7366r":
        return ChipCounter(Ls7366r(spi[0], f"{axis.value}.select"), table.counts_per_deg, board.clock)
    channels = (table.a, table.b)[: tables.channels]
    pair = GpioPair(board.gpio, board.chip(), channels, consumer=f"rotator-{axis.value}", pull=tables.pull)
    board.opened.callback(pair.close)
    return QuadratureCounter(pair, table.counts_per_deg, board.clock)


def _bridge(parts: Assembly, axis: Axis, lines: OutputLines, files: Files) -> Bridge:
    tables = parts.config.bridge
    pwm = KernelPwm(files, tables.of(axis).pwm, tables.pwm_hz, parts.board.sleep)
    parts.board.opened.callback(pwm.close)
    minus = f"{axis.value}_minus" if "minus" in tables.inputs(axis) else None
    return Bridge(lines, pwm, f"{axis.value}_plus", minus, dead_time_s=tables.dead_time_s)


def _spec(parts: Assembly, axis: Axis) -> BridgeSpec:
    table = parts.config.bridge.of(axis)
    count_deg = max(1.0 / abs(table.counts_per_deg), FINEST_DEG)
    return BridgeSpec(parts.config.axis(axis).speed_dps, table.accel_dps2, table.min_duty, count_deg)


def simulate(axes: SimulatedAxes) -> SimBridgeRotor:
    tables = axes.config.bridge

    def spec(axis: Axis) -> BridgeAxisSpec:
        table, low_deg = tables.of(axis), axes.config.axis(axis).min_deg
        if table.home != "none":
            low_deg = min(low_deg, table.home_deg)
        return BridgeAxisSpec(
            table.plus,
            table.minus if tables.lines == "two" else None,
            table.pwm,
            table.a,
            table.b if tables.channels == 2 else None,
            table.counts_per_deg * (2 if tables.channels == 1 else 1),
            axes.motor(axis, low_deg - STOP_BEYOND_DEG),
            axes.start_deg(axis),
            table.index,
            table.home_deg,
            KERNEL_SELECTS[table.select] if table.counter == "ls7366r" else None,
        )

    return SimBridgeRotor(
        spec(Axis.AZIMUTH), spec(Axis.ELEVATION), axes.clock, axes.bus_sleep, enable_pin=tables.enable
    )
