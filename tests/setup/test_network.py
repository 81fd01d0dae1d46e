"""`rotator setup network`: rotctld and the page open for one network by one question, and close again to the byte."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.cli.network import wait_for_the_pc
from rotator.config.load import SIMULATED, parse, profiles, shipped
from rotator.exchange.sources import Source
from rotator.links.listening import addresses
from rotator.monitor.transcript import LinkNote, Peer, Way, encode_link, encode_peer, encode_piece
from rotator.setup.network import BLOCK as MARKS
from rotator.setup.network import Opened, closed, open_to
from rotator.setup.plan import SetupError
from tests.setup.conftest import ROTATOR, Card

PORT = 4533
TO_THE_PC = Opened("", PORT, None, "192.168.1.0/24")
BEGIN, END = MARKS.begin, MARKS.end
ANNOUNCED = "etc/avahi/services/rotator.service"
BLOCK = f"""\
{BEGIN}
# was: tcp = "127.0.0.1:4533"
tcp = "0.0.0.0:4533"
allow = ["127.0.0.1", "192.168.1.0/24"]
{END}
"""
PAGE = f"""\
{BEGIN}
[page]
listen = "0.0.0.0:8232"
allow = ["127.0.0.1", "192.168.1.0/24"]
{END}
"""
OPENED = ROTATOR.replace('tcp = "127.0.0.1:4533"\n', BLOCK) + PAGE


@pytest.fixture
def with_avahi(card: Card) -> Card:
    (card.root / "etc/avahi/services").mkdir(parents=True)
    (card.root / "etc/hostname").write_text("shack\n")
    return card


def test_one_link_opens_and_the_rest_of_the_file_stays(with_avahi: Card) -> None:
    said = with_avahi.setup("network", "--allow", "192.168.1.7/24", "--yes")
    assert said.code == 0, said.text
    assert with_avahi.rotator.read_text() == OPENED
    link = parse(with_avahi.rotator.read_text(), "x").link[0]
    assert (link.tcp, link.allow) == ("0.0.0.0:4533", ["127.0.0.1", "192.168.1.0/24"])
    assert "<port>4533</port>" in (with_avahi.root / ANNOUNCED).read_text()
    assert "Host shack.local, Port 4533" in said.text
    assert "rotctl -m 2 -r shack.local:4533 p" in said.text
    assert "Browser    http://shack.local:8232" in said.text


def test_another_network_takes_the_place_of_the_first(with_avahi: Card) -> None:
    with_avahi.setup("network", "--allow", "10.0.0.0/8", "--yes")
    with_avahi.setup("network", "--allow", "192.168.1.0/24", "--yes")
    assert with_avahi.rotator.read_text() == OPENED


def test_the_question(with_avahi: Card) -> None:
    last = len({address.network for address in addresses()}) + 1
    said = with_avahi.setup("network", answer=f"192.168.1\n{last}\ny\n")
    assert '"192.168.1" is no network: type one such as 192.168.1.0/24' in said.text
    assert said.code == 0
    assert parse(with_avahi.rotator.read_text(), "x").link[0].allow is None


def test_a_card_is_named_by_its_own_name_and_no_address_of_this_machine(with_avahi: Card) -> None:
    said = with_avahi.setup("network", "--allow", "all", "--yes").text
    assert "The card of shack. Its address is known only after it has started." in said
    assert "rotctl -m 2 -r shack.local:4533 p" in said
    for here in (socket.gethostname(), *(str(each.ip) for each in addresses())):
        assert here not in said


def test_a_card_without_name_and_avahi_leaves_the_address_open(card: Card) -> None:
    said = card.setup("network", "--allow", "all", "--yes").text
    assert "On the PC, where ADDRESS is what `hostname -I` prints on the Pi:" in said
    assert "rotctl -m 2 -r ADDRESS:4533 p" in said
    assert "sudo apt install avahi-daemon" in said
    assert not (card.root / ANNOUNCED).exists()


def test_a_file_without_rotctld_gets_one(card: Card) -> None:
    text = '[rotor]\nhardware = "sim"'
    card.rotator.write_text(text)
    card.setup("network", "--allow", "192.168.1.0/24", "--yes")
    assert parse(card.rotator.read_text(), "x").link[0].tcp == "0.0.0.0:4533"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((), "no local network is known on this card: say which may with --allow 192.168.1.0/24"),
        (("--allow", "192.168.1"), "--allow: "),
        (("--allow", "192.168.1.0"), "did you mean 192.168.1.0/24?"),
        (("--allow", "::1/64"), '"::1/64" is IPv6, and the box listens on IPv4'),
        (("--allow", "all", "--config", "none.toml"), "there is no none.toml"),
    ],
)
def test_what_cannot_be(card: Card, words: tuple[str, ...], said: str) -> None:
    before = card.files()
    done = card.setup("network", *words, "--yes")
    assert (done.code, said in done.text) == (1, True)
    assert card.files() == before


def test_a_page_that_is_open_or_switched_off_stays(card: Card) -> None:
    for page in ('[page]\nlisten = "0.0.0.0:80"\n', "[page]\nenabled = false\n"):
        card.rotator.write_text(ROTATOR + page)
        said = card.setup("network", "--allow", "192.168.1.0/24", "--yes")
        assert card.rotator.read_text().endswith(END + "\n" + page)
        assert ("Browser" in said.text) is ("listen" in page)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('page.listen = "127.0.0.1:99"\n' + ROTATOR, 'write listen = "0.0.0.0:99" there, and run this again'),
        ('page = { listen = "127.0.0.1:99" }\n' + ROTATOR, 'write listen = "0.0.0.0:99" there, and run this again'),
        (
            'link = [{ protocol = "rotctld", tcp = "127.0.0.1:99" }]\n',
            'has no heading of its own here: write tcp = "0.0.0.0:99" there',
        ),
        (OPENED.replace(END, f"read_only = true\n{END}", 1), '"read_only = true" between the marks'),
        (OPENED.replace(f"{END}\n", "", 1), "only one of the two marks"),
    ],
)
def test_what_is_written_in_another_way_is_left_to_the_person(card: Card, text: str, said: str) -> None:
    card.rotator.write_text(text)
    before = card.files()
    done = card.setup("network", "--allow", "192.168.1.0/24", "--yes")
    assert done.code == 1
    assert said in " ".join(done.text.split())
    assert card.files() == before


def test_the_installer_announces_the_same(with_avahi: Card) -> None:
    """Else each of the two would rewrite what the other wrote."""
    with_avahi.setup("network", "--allow", "all", "--yes")
    template = (Path(__file__).parents[2] / "install/avahi.service").read_text()
    assert (with_avahi.root / ANNOUNCED).read_text() == template.replace("@PORT@", "4533")


@given(
    st.sampled_from([SIMULATED, *profiles()]),
    st.sampled_from([None, "10.0.0.0/8"]),
    st.sampled_from(["\n", "\r\n"]),
    st.permutations(["", '\nallow = [\n  "10.1.0.0/16",  # home\n]', "\nread_only = true"]).map("".join),
    st.one_of(
        st.sampled_from(["", "[page]\n", "[page]  # mine\n"]),
        st.permutations(['reading = "paired"\n', 'allow = ["10.1.0.0/16"]\n', 'listen = "127.0.0.1:8232"\n']).map(
            lambda keys: "".join(("[page]\n", *keys))
        ),
    ),
)
def test_every_shipped_file_opens_and_comes_back_to_the_byte(
    name: str, allow: str | None, end: str, more: str, page: str
) -> None:
    text = shipped(name).replace('tcp = "127.0.0.1:4533"', f'tcp = "127.0.0.1:4533"{more}')
    text = (text + page).replace("\n", end)
    opened = open_to(text, allow)
    link = next(link for link in parse(opened.text, name).link if link.protocol == "rotctld")
    assert (link.tcp, link.allow) == ("0.0.0.0:4533", allow and ["127.0.0.1", allow])
    table = parse(opened.text, name).page
    assert (table.listen, table.allow) == ("0.0.0.0:8232", allow and ["127.0.0.1", allow])
    assert closed(opened.text) == text


# --- the test from the PC


SETTINGS: dict[str, object] = {"tcp": f"0.0.0.0:{PORT}", "allow": ["127.0.0.1", "192.168.1.0/24"]}


class Box:
    """What a running box shows on its monitor."""

    def __init__(self, folder: Path) -> None:
        self.config = folder / "box.toml"
        self.config.write_text(f'[monitor]\npath = "{folder}/monitor"\n[[link]]\nprotocol = "gs232b"\npty = "x"\n')
        self.monitor = socket.socket(socket.AF_UNIX)
        self.monitor.bind(f"{folder}/monitor")
        self.monitor.listen()


@pytest.fixture
def box(tmp_path: Path) -> Iterator[Box]:
    made = Box(tmp_path)
    yield made
    made.monitor.close()


PC, HERE = Source("rotctld", 2), Source("rotctld", 1)
NOTE = encode_link(LinkNote("rotctld", SETTINGS))
PEERS = (encode_peer(Peer(HERE, "127.0.0.1")), encode_peer(Peer(PC, "192.168.1.20")))


def asks(who: Source, question: bytes = b"p\n") -> str:
    return encode_piece(datetime.now(), who, Way.IN, question, text=True)


def old(keys: dict[str, object]) -> tuple[str, ...]:
    """It answers the PC too, until it is started again."""
    return (encode_link(LinkNote("rotctld", keys)), *PEERS, asks(PC))


@pytest.mark.parametrize(
    ("lines", "works", "said"),
    [
        (old({"tcp": f"127.0.0.1:{PORT}"}), None, "the running box has the old settings: start it again first"),
        (old(SETTINGS | {"allow": ["127.0.0.1", "10.0.0.0/8"]}), None, "the running box has the old settings"),
        ((), None, "the box has ended"),
        (
            (NOTE, encode_peer(Peer(PC, "10.9.9.9")), asks(PC)),
            False,
            "10.9.9.9 has just asked, and is not in 192.168.1.0/24",
        ),
        *(
            (
                ("# rotator", NOTE, *PEERS, asks(PC, b"\\dump_state\n"), asks(HERE), asks(PC, question)),
                True,
                "\n192.168.1.20 has just asked for the position: it works.\n",
            )
            for question in (b"p\n", b"+p\n", b"\\get_pos\n", b"\\dump_state\np\n")
        ),
    ],
)
def test_what_the_first_question_of_a_pc_proves(
    box: Box, capsys: pytest.CaptureFixture[str], lines: tuple[str, ...], works: bool | None, said: str
) -> None:
    def show() -> None:
        watcher, _ = box.monitor.accept()
        watcher.sendall("".join(f"{line}\n" for line in lines).encode())
        watcher.close()

    shower = threading.Thread(target=show)
    shower.start()
    if works is None:
        with pytest.raises(SetupError, match=said):
            wait_for_the_pc(box.config, TO_THE_PC, 20.0)
    else:
        assert wait_for_the_pc(box.config, TO_THE_PC, 20.0) is works
        assert said in capsys.readouterr().out
    shower.join()
