"""The pages for a person with a soldering iron: links lead somewhere, sums and pins are right."""

from __future__ import annotations

import re
import textwrap
import tomllib
from pathlib import Path
from typing import Any

import pytest

from docs.drawings.album import profile
from docs.drawings.header import GPIO_PINS
from docs.drawings.panel import LIMITS, PANEL
from hw.moteus.faults import FAULTS
from hw.ports import Direction
from hw.sensors.cam import Cam
from hw.sensors.cam_count import CamCount
from rotator.config.load import shipped
from rotator.config.model import Config
from rotator.exchange.faults import FaultKind
from rotator.panel.ladder import LEVELS
from tests.tables import every_row

DOCS = Path(__file__).parents[2] / "docs"
PAGES = [str(path.relative_to(DOCS)) for path in sorted(DOCS.rglob("*.md"))]
BUILDS = {
    "g5500",
    "g450",
    "g1000",
    "ham4",
    "f1efw",
    "u100",
    "tv-rotator",
    "isel",
    "servos",
    "orbit360",
    "slew-drive",
    "controller",
    "satnogs",
}
"""Shipped configurations with a page of their own, from parts to the first pass."""


def text(name: str) -> str:
    return (DOCS / name).read_text(encoding="utf-8")


def anchors(name: str) -> set[str]:
    """Headings as the usual viewers make anchors of them."""
    headings = re.findall(r"^#+ (.+)$", re.sub(r"```.*?```", "", text(name), flags=re.DOTALL), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@every_row("page", [*PAGES, "../README.md"])
def test_every_link_leads_somewhere(page: str) -> None:
    folder = (DOCS / page).parent
    for target in re.findall(r"\]\((?!https?:)([^)]+)\)", text(page)):
        path, _, anchor = target.replace("\n", "").partition("#")
        led = (folder / path).resolve() if path else DOCS / page
        assert led.is_file(), target
        if anchor:
            assert anchor in anchors(str(led.relative_to(DOCS))), target


def test_every_page_is_reached_from_the_map() -> None:
    reached = set(re.findall(r"\]\(([\w/-]+\.md)\)", text("index.md").replace("\n", "")))
    assert reached == set(PAGES) - {"index.md"}


def test_every_picture_is_shown_on_some_page() -> None:
    every = "".join(text(page) for page in [*PAGES, "../README.md"])
    shown = set(re.findall(r"\((?:\.\./|docs/)?img/([\w.-]+)\)", every))
    assert shown == {path.name for path in (DOCS / "img").iterdir()}


@pytest.mark.parametrize("build", [0, 1, 2])
def test_the_prices_add_up(build: int) -> None:
    table = text("parts.md").split("## ")[0]
    rows = [line.split("|") for line in table.splitlines() if " | " in line]
    column = [row[1 + build].strip(" *") for row in rows if len(row) >= 4]
    prices = [int(price) for price in column if price.isdigit()]
    *single, total = prices
    assert len(single) > 10
    assert sum(single) == total


def test_the_g_5500s_table_names_the_gpios_of_its_profile() -> None:
    rows = dict(re.findall(r"\| relay \d, GPIO (\d+) \| `relays\.(\w+)`", text("paths/g5500.md")))
    relays = profile("g5500").relays
    assert {key: int(gpio) for gpio, key in rows.items()} == {
        "azimuth_cw": relays.azimuth_cw,
        "azimuth_ccw": relays.azimuth_ccw,
        "elevation_up": relays.elevation_up,
        "elevation_down": relays.elevation_down,
    }


def settings(name: str) -> dict[str, Any]:
    """All TOML on the page, as one file."""
    return tomllib.loads("\n".join(re.findall(r"```toml\n(.*?)```", text(name), flags=re.DOTALL)))


def fragments() -> list[tuple[str, str]]:
    """Every piece of a configuration on the pages."""
    return [
        (page, textwrap.dedent(block))
        for page in PAGES
        for block in re.findall(r"^ *```toml\n(.*?)```$", text(page), flags=re.DOTALL | re.MULTILINE)
    ]


@every_row(("page", "fragment"), fragments())
def test_every_piece_of_a_file_is_one_that_the_box_takes(page: str, fragment: str) -> None:
    kind = 'rotor.type = "digipot"\n' if page.endswith("orbit360.md") else ""
    Config.model_validate(tomllib.loads(kind + fragment))


@every_row("build", sorted(BUILDS))
def test_page_and_configuration_name_each_other(build: str) -> None:
    page = f"paths/{build}.md"
    assert f"--profile {build}" in text(page)
    assert f"docs/{page}" in shipped(build)
    for other in ("wiring.md", "index.md", "configuration.md"):
        assert f"]({page})" in text(other)


@pytest.mark.parametrize("build", ["u100", "tv-rotator", "orbit360", "ham4", "slew-drive"])
def test_each_gpio_on_the_page_is_the_profiles_and_at_that_pin_of_the_header(build: str) -> None:
    """Tables: what, GPIO, header pin, perhaps more, key."""
    rows = re.findall(r"^[^|]+ \| (\d+) \| (\d+) \|(?:[^|]+\|)? `([\w.]+)`$", text(f"paths/{build}.md"), re.MULTILINE)
    used = {key: pin for pin, key in profile(build).pins() if not key.startswith(("lcd.", "panel."))}
    assert {key: int(gpio) for gpio, _, key in rows} == used
    assert all(GPIO_PINS[int(gpio)] == int(pin) for gpio, pin, _ in rows)


def test_the_servos_table_names_what_the_profile_has() -> None:
    page, servo = text("paths/servos.md"), profile("servos").servo
    assert servo.enable is not None
    assert f"OE | GPIO {servo.enable}, and 1 kΩ to 3.3 V | {GPIO_PINS[servo.enable]} | `servo.enable`\n" in page
    assert f"output {servo.azimuth.channel} | azimuth servo |" in page
    assert f"output {servo.elevation.channel} | elevation servo |" in page
    assert f"at 0x{servo.address:02x}" in page


def test_the_steppers_table_names_the_lines_of_the_profile() -> None:
    config = profile("satnogs")
    rows = re.findall(r"^[^|]+ \| (\d+) \| (\d+) \| `([\w.]+)`$", text("paths/satnogs.md"), re.MULTILINE)
    rows += re.findall(r"^(?:SCK|SDI|SDO) of both \| (\d+) \| (\d+)()$", text("paths/satnogs.md"), re.MULTILINE)
    assert {int(gpio) for gpio, _, _ in rows} == {pin for pin, _ in config.pins()}
    assert all(GPIO_PINS[int(gpio)] == int(pin) for gpio, pin, _ in rows)
    keyed = {key: int(gpio) for gpio, _, key in rows if key}
    assert keyed == {key: pin for pin, key in config.pins() if key in keyed}


def test_the_moteus_page_sets_the_ids_of_the_profile() -> None:
    moteus = profile("isel").moteus
    assert f"`id.id` | {moteus.azimuth.id} | {moteus.elevation.id} |" in text("paths/isel.md")


def test_the_panels_table_names_its_gpios() -> None:
    rows = re.findall(r" \| GPIO (\d+), header pin (\d+) \| `(\w+)\.(\w+)`", text("panel.md"))
    assert {key: int(gpio) for gpio, _, _, key in rows} == PANEL.switches | LIMITS.switches
    assert all(GPIO_PINS[int(gpio)] == int(pin) for gpio, pin, _, _ in rows)


@every_row("build", ["f1efw", "g5500", "spid", "u100", "isel", "servos"])
def test_the_panels_gpios_are_free_beside_every_profile_but_that_of_the_digital_pots(build: str) -> None:
    used = {pin for pin, key in profile(build).pins() if not key.startswith("panel.")}
    assert not used & {*PANEL.switches.values(), *LIMITS.switches.values()}


def test_the_shipped_panel_is_the_one_on_the_page() -> None:
    assert profile("u100").panel == PANEL


def test_the_jog_switches_read_what_the_page_says() -> None:
    page = text("panel.md")
    words = {
        (1, 0): "CW", (-1, 0): "CCW", (0, 1): "up", (0, -1): "down",
        (1, 1): "CW and up", (-1, -1): "CCW and down", (1, -1): "CW and down", (-1, 1): "CCW and up",
    }  # fmt: skip
    for (azimuth, elevation), share in words.items():
        assert f"{share} | {LEVELS[Direction(azimuth), Direction(elevation)]:.3f}" in page
    assert f"neither | {LEVELS[Direction.OFF, Direction.OFF]:.3f}" in page


def test_the_sensors_page_has_tables_that_the_file_accepts() -> None:
    said = settings("sensors.md")
    config = Config.model_validate({key: said[key] for key in ("azimuth", "elevation", "compass", "mount")})
    assert config.azimuth.sensor.kind == "as5600"
    assert config.elevation.sensor.kind == "mpu6050"
    assert config.compass.kind == "bno055"


def test_the_compass_page_has_a_file_that_is_accepted() -> None:
    config = Config.model_validate(settings("compass.md"))
    assert config.azimuth.sensor.kind == "qmc5883l"


def test_the_digital_pots_points_are_ones_that_the_file_accepts() -> None:
    values = tomllib.loads(shipped("orbit360"))
    values["digipot"]["azimuth"] |= settings("paths/orbit360.md")["digipot"]["azimuth"]
    assert len(Config.model_validate(values).digipot.azimuth.steps) == 5


@every_row("kind", FaultKind)
def test_every_fault_has_its_heading_and_anchor(kind: FaultKind) -> None:
    assert f"\n### {kind.text}\n" in text("troubleshooting.md")
    assert kind.anchor in anchors("troubleshooting.md")


def test_the_moteus_numbers_on_the_page_are_the_controllers() -> None:
    table = text("troubleshooting.md").split("### controller fault\n")[1].split("\n### ")[0]
    rows = re.findall(r"^([\d, ]+) \|", table, re.MULTILINE)
    numbers = {int(number) for row in rows for number in row.split(",")}
    assert len(numbers) > 8
    assert numbers <= set(FAULTS)
    fault = FAULTS[34]
    assert f"{fault.name} (34): {fault.remedy}, then acknowledge it" in " ".join(table.split())


def test_the_troubles_of_a_count_are_those_that_it_tells() -> None:
    """A counter is told what no rotor does."""
    told = text("troubleshooting.md").split("### count lost\n")[1].split("\n### ")[0]
    count = CamCount(Cam(spacing_deg=5, closed_deg=1, closes_at_deg=0, speed_dps=6))
    assert not count.place(0.0, 123.0, closed=True)
    assert count.trouble == "the contact is closed, which it is not at 123.0°"
    assert "which it is not at 120.0°" in told
    count.place(0.0, 100.5, closed=True)
    count.change(60.0, closed=True, lost=3)
    assert count.trouble in told
