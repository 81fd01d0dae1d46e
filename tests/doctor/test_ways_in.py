"""The checks of links, user and folders, and of what an axis still lacks."""

from __future__ import annotations

import socket
from collections.abc import Iterator

import pytest

from tests.doctor.conftest import STATION, Pi

GS0 = '[[link]]\nprotocol = "gs232b"\nserial = "/dev/ttyGS0"\n'
UNIT = "[Service]\nUser=rotator\nSupplementaryGroups=gpio i2c spi dialout\n"


def tcp(where: str) -> str:
    return f'[[link]]\nprotocol = "rotctld"\ntcp = "{where}"\n'


@pytest.fixture
def taken() -> Iterator[int]:
    """A port on which somebody listens."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server.getsockname()[1]


# --- serial ports


def test_a_serial_port(pi: Pi) -> None:
    pi.station(GS0)
    pi.write("/dev/ttyGS0")
    assert pi.only("serial ports").mark == "✓"


def test_the_gadgets_port_is_made_by_setup(pi: Pi) -> None:
    pi.station(GS0)
    finding = pi.only("serial ports")
    assert finding.ok is False
    assert "sudo rotator setup usb-serial" in finding.advice


def test_another_port_that_is_not_there(pi: Pi) -> None:
    pi.station(GS0.replace("ttyGS0", "ttyUSB0"))
    pi.write("/dev/ttyACM0")
    assert "/dev/ttyACM0" in pi.only("serial ports").advice


def test_a_port_with_the_kernels_console_on_it(pi: Pi) -> None:
    pi.station(GS0.replace("ttyGS0", "serial0"))
    pi.write("/dev/ttyS0")
    pi.machine.at("/dev/serial0").symlink_to("ttyS0")
    assert pi.only("serial ports").mark == "✓"
    pi.write("/proc/cmdline", "console=ttyS0,115200 console=tty1")
    finding = pi.only("serial ports")
    assert finding.ok is False
    assert "raspi-config" in finding.advice


def test_a_url_is_left_alone(pi: Pi) -> None:
    pi.station(GS0.replace("/dev/ttyGS0", "rfc2217://box:2217"))
    assert pi.only("serial ports").mark == "–"


# --- pseudo-terminals


def test_a_pseudo_terminal(pi: Pi) -> None:
    pi.station('[[link]]\nprotocol = "gs232b"\npty = "/run/rotator/gs232"\n')
    assert "will be made" in pi.only("pseudo-terminals").found
    pi.write("/dev/pts/3")
    pi.machine.at("/run/rotator").mkdir(parents=True)
    pi.machine.at("/run/rotator/gs232").symlink_to(pi.machine.at("/dev/pts/3"))
    assert pi.only("pseudo-terminals").mark == "✓"


def test_a_file_in_the_way_of_a_pseudo_terminal(pi: Pi) -> None:
    pi.station('[[link]]\nprotocol = "gs232b"\npty = "/run/gs232"\n')
    pi.write("/run/gs232")
    finding = pi.only("pseudo-terminals")
    assert finding.ok is False
    assert "Remove it" in finding.advice


# --- TCP ports


def test_a_free_port(pi: Pi, taken: int) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        free = server.getsockname()[1]
    pi.station(tcp(f"127.0.0.1:{free}"))
    assert (pi.only("TCP ports").mark, pi.only("TCP ports").found) == ("✓", f"127.0.0.1:{free}: free")


def listens(pi: Pi, port: int, command: list[str]) -> None:
    pi.write("/proc/net/tcp", f"  sl  local_address ...\n   0: 0100007F:{port:04X} 00000000:0000 0A 0 0 0 0 0 7791\n")
    pi.write("/proc/512/cmdline", "".join(f"{word}\0" for word in command))
    pi.machine.at("/proc/512/fd").mkdir(exist_ok=True)
    pi.machine.at("/proc/512/fd/6").symlink_to("socket:[7791]")


def test_a_port_that_hamlib_has(pi: Pi, taken: int) -> None:
    pi.station(tcp(f"127.0.0.1:{taken}"))
    listens(pi, taken, ["rotctld", "-m", "1"])
    finding = pi.only("TCP ports")
    assert (finding.ok, finding.found) == (False, f"127.0.0.1:{taken} is taken by rotctld")
    assert "another port" in finding.advice


@pytest.mark.parametrize(
    "command",
    [
        ["/opt/rotator/current/bin/python", "/opt/rotator/current/bin/rotator", "run"],
        ["python3", "-m", "rotator", "run"],
    ],
)
def test_a_port_that_the_running_box_has(pi: Pi, taken: int, command: list[str]) -> None:
    pi.station(tcp(f"127.0.0.1:{taken}"))
    listens(pi, taken, command)
    pi.change(ask_box=lambda: "you may not use /run/rotator/console")
    assert (pi.only("TCP ports").mark, pi.only("TCP ports").found) == ("✓", f"127.0.0.1:{taken}: the running box")


def test_a_port_that_the_box_of_another_folder_has(pi: Pi, taken: int) -> None:
    """No box runs with this configuration: its start would fail."""
    pi.station(tcp(f"127.0.0.1:{taken}"))
    listens(pi, taken, ["rotator", "run"])
    found = f"127.0.0.1:{taken} is taken by a box with another configuration"
    assert (pi.only("TCP ports").mark, pi.only("TCP ports").found) == ("✗", found)


def test_a_port_taken_by_a_process_of_another_user(pi: Pi, taken: int) -> None:
    pi.station(tcp(f"127.0.0.1:{taken}"))
    finding = pi.only("TCP ports")
    assert finding.mark == "!"
    assert "sudo rotator doctor" in finding.advice


def test_a_link_that_is_open_to_the_network(pi: Pi) -> None:
    pi.station(tcp("0.0.0.0:15331"))
    finding = pi.only("TCP ports")
    assert finding.mark == "!"
    assert "open to the network" in finding.found
    assert "127.0.0.1:15331" in finding.advice


@pytest.mark.parametrize(
    ("key", "told"),
    [
        ("read_only = true", "it is read_only: nothing there turns the antenna"),
        ('allow = ["192.168.1.20", "10.0.0.0/8"]', "for 192.168.1.20, 10.0.0.0/8 (allow)"),
    ],
)
def test_a_link_that_strangers_cannot_move_is_no_warning(pi: Pi, key: str, told: str) -> None:
    pi.station(tcp("0.0.0.0:15331") + f"{key}\n")
    finding = pi.only("TCP ports")
    assert finding.mark == "✓"
    assert told in finding.found


@pytest.mark.parametrize(("host", "mark"), [("localhost", "✓"), ("127.0.0.2", "✓"), ("0.0.0.0", "!")])
def test_loopback_is_told_from_the_network(pi: Pi, host: str, mark: str) -> None:
    pi.station(tcp(f"{host}:15332"))
    assert pi.only("TCP ports").mark == mark


@pytest.mark.parametrize("host", ["192.0.2.7", "no-such-host.invalid"])
def test_an_address_of_another_machine(pi: Pi, host: str) -> None:
    pi.station(tcp(f"{host}:4533"))
    finding = pi.only("TCP ports")
    assert finding.ok is False
    assert "address of this machine" in finding.advice


# --- UDP ports


def udp(where: str) -> str:
    return f'[[link]]\nprotocol = "pstrotator"\nudp = "{where}"\n'


@pytest.fixture
def heard() -> Iterator[int]:
    """A port at which somebody hears datagrams."""
    with socket.socket(type=socket.SOCK_DGRAM) as ears:
        ears.bind(("127.0.0.1", 0))
        yield ears.getsockname()[1]


def test_a_free_udp_port_though_the_tcp_port_is_taken(pi: Pi, taken: int) -> None:
    pi.station(udp(f"127.0.0.1:{taken}"))
    assert (pi.only("UDP ports").mark, pi.only("UDP ports").found) == ("✓", f"127.0.0.1:{taken}: free")
    assert pi.only("TCP ports").mark == "–"


@pytest.mark.parametrize(
    ("command", "mark", "found"),
    [(["rotator", "run"], "✓", ": the running box"), (["PstRotator.exe"], "✗", " is taken by PstRotator.exe")],
)
def test_a_udp_port_that_is_taken(pi: Pi, heard: int, command: list[str], mark: str, found: str) -> None:
    pi.station(udp(f"127.0.0.1:{heard}"))
    listens(pi, heard, command)
    pi.change(ask_box=lambda: "you may not use /run/rotator/console")
    pi.write("/proc/net/udp", pi.machine.at("/proc/net/tcp").read_text().replace(" 0A ", " 07 "))
    pi.machine.at("/proc/net/tcp").unlink()
    assert (pi.only("UDP ports").mark, pi.only("UDP ports").found) == (mark, f"127.0.0.1:{heard}{found}")


def test_a_udp_port_that_is_open_to_the_network(pi: Pi) -> None:
    pi.station(udp("0.0.0.0:15333"))
    assert pi.only("UDP ports").mark == "!"
    assert "open to the network" in pi.only("UDP ports").found


# --- groups


def test_groups(pi: Pi) -> None:
    pi.station(GS0)
    assert (pi.only("groups").mark, pi.only("groups").found) == ("✓", "pi is in dialout, gpio, i2c")


def test_a_user_who_lacks_some(pi: Pi) -> None:
    pi.station(GS0)
    pi.write("/etc/group", "dialout:x:20:pi\npi:x:1000:\ngpio:x:997:\ni2c:x:998:alice\n")
    finding = pi.only("groups")
    assert finding.ok is False
    assert "sudo usermod -aG gpio,i2c pi" in finding.advice


def test_without_serial_ports_dialout_is_not_asked_for(pi: Pi) -> None:
    assert pi.only("groups").found == "pi is in gpio, i2c"


def test_the_services_user_gets_groups_from_its_unit(pi: Pi) -> None:
    pi.write("/etc/systemd/system/rotator.service", UNIT)
    pi.write("/etc/passwd", "pi:x:1000:1000::/home/pi:/bin/bash\nrotator:x:990:990::/var/lib/rotator:/bin/false\n")
    assert [finding.mark for finding in pi.found("groups")] == ["✓", "✓"]
    pi.write("/etc/systemd/system/rotator.service", "[Service]\nUser=rotator\n")
    service, person = pi.found("groups")
    assert (service.ok, person.mark) == (False, "✓")
    assert "sudo usermod -aG gpio,i2c rotator" in service.advice


def test_a_service_without_its_user(pi: Pi) -> None:
    pi.write("/etc/systemd/system/rotator.service", UNIT)
    assert "there is no user rotator" in pi.found("groups")[0].found


def test_beside_the_service_a_person_without_groups_is_a_warning(pi: Pi) -> None:
    pi.write("/etc/systemd/system/rotator.service", UNIT)
    pi.write("/etc/passwd", "alice:x:1001:1001::/home/a:/bin/bash\nrotator:x:990:990::/var/lib/rotator:/bin/false\n")
    pi.change(user="alice")
    assert [finding.mark for finding in pi.found("groups")] == ["✓", "!"]


def test_root_needs_no_group(pi: Pi) -> None:
    pi.change(user="root")
    assert pi.only("groups").found == "root needs none"


# --- the state folder


def test_a_state_folder(pi: Pi) -> None:
    assert (pi.only("state folder").mark, pi.only("state folder").found) == ("✓", "/var/lib/rotator: 20.0 GB free")


@pytest.mark.parametrize(("free_bytes", "mark"), [(300_000_000, "!"), (4096, "✗")])
def test_a_full_card(pi: Pi, free_bytes: int, mark: str) -> None:
    pi.change(free_bytes=lambda _path: free_bytes)
    finding = pi.only("state folder")
    assert finding.mark == mark
    assert "journalctl --vacuum-size" in finding.advice


def test_a_folder_that_cannot_be_made(pi: Pi) -> None:
    pi.station("", base=STATION.replace("/var/lib/rotator/", "/dev/watchdog/"))
    finding = pi.only("state folder")
    assert finding.ok is False
    assert "sudo install -d -o pi /dev/watchdog" in finding.advice


# --- the axes


def test_axes_that_are_set_up(pi: Pi) -> None:
    assert [finding.mark for finding in pi.found("axes")] == ["✓", "✓"]


@pytest.mark.parametrize(
    ("line", "lacks"),
    [
        ("calibration = [[0.05, 0], [0.95, 180]]\n", "calibration"),
        ("max_deg = 180\n", "limits"),
        ("direction_checked = true\n[state]", "direction check"),
    ],
)
def test_an_axis_that_is_not(pi: Pi, line: str, lacks: str) -> None:
    pi.station("", base=STATION.replace(line, "[state]" if "[state]" in line else ""))
    azimuth, elevation = pi.found("axes")
    assert (azimuth.mark, elevation.ok) == ("✓", False)
    assert elevation.found.endswith(f"it lacks {lacks}")
    assert "rotator calibrate elevation" in elevation.advice
