"""What install.sh refuses, each in one sentence that tells what to do, and nothing is left of the attempt."""

from __future__ import annotations

from tests.install.roots import Root, Said


def refused(root: Root, *command: str, **environment: str) -> str:
    """The one sentence, after making sure that the machine is as it was."""
    before = root.inventory(times=False)
    said: Said = root.run(*command, **environment)
    assert said.code == 1, said.text
    assert root.inventory(times=False) == before
    errors = [line for line in said.lines if not line.startswith("  ") and line != "This is what it would do:"]
    assert len(errors) == 1, said.text
    assert errors[0].startswith("install.sh: ")
    return errors[0].removeprefix("install.sh: ")


def test_not_root(bare: Root) -> None:
    said = refused(bare, "runuser", "-u", "nobody", "--", "/src/install.sh", "--profile", "g5500")
    assert said == "only root may do that: sudo ./install.sh --profile g5500; nothing has been changed"


def test_an_unknown_option(bare: Root) -> None:
    assert (
        refused(bare, "/src/install.sh", "--frobnicate") == "there is no option --frobnicate; see ./install.sh --help"
    )


def test_an_option_without_its_value(bare: Root) -> None:
    assert refused(bare, "/src/install.sh", "--profile") == "--profile needs a value; see ./install.sh --help"


def test_a_python_that_is_too_old(bare: Root) -> None:
    bare.shell("mkdir /run/old && echo 'import sys; sys.version_info = (3, 9, 2)' >/run/old/sitecustomize.py").check()
    assert refused(bare, "/src/install.sh", PYTHONPATH="/run/old").startswith(
        "python3 is not Python 3.11, 3.12 or 3.13"
    )


def test_no_python_at_all(bare: Root) -> None:
    assert refused(bare, "/src/install.sh", PYTHON="python3.99").startswith(
        "python3.99 is not Python 3.11, 3.12 or 3.13"
    )


def test_no_venv(bare: Root) -> None:
    bare.run("dpkg", "--purge", "--force-depends", "python3-venv", "python3.11-venv").check()
    assert refused(bare, "/src/install.sh", "--yes").startswith(
        "Python cannot make a virtual environment: sudo apt install python3-venv"
    )


def test_no_network(bare: Root) -> None:
    said = refused(bare, "unshare", "--net", "/src/install.sh", "--yes")
    assert said.startswith("the network cannot be reached; for a machine without one see --fetch-wheels and --wheels")


def test_a_small_disk(bare: Root) -> None:
    bare.run("mount", "-t", "tmpfs", "-o", "size=20m", "tmpfs", "/opt").check()
    assert refused(bare, "/src/install.sh").startswith(
        "the disk is full: 150 MB are needed in /opt/rotator, 20 are free"
    )


def test_a_disk_that_fills_up_on_the_way(bare: Root) -> None:
    bare.run("mount", "-t", "tmpfs", "-o", "size=300m,nr_inodes=800", "tmpfs", "/opt").check()
    assert refused(bare, "/src/install.sh", "--yes").startswith("the disk is full: 150 MB are needed")


def test_a_profile_there_is_not(bare: Root) -> None:
    said = refused(bare, "/src/install.sh", "--profile", "g5501")
    assert said.startswith("there is no profile g5501; there are: simulated controller f1efw g1000 g450 g5500 ham4 ")


def test_wheels_that_are_not_there(bare: Root) -> None:
    assert refused(bare, "/src/install.sh", "--wheels", "/nowhere").startswith("there is no folder /nowhere")


def test_a_person_called_rotator(bare: Root) -> None:
    bare.run("useradd", "--create-home", "rotator").check()
    assert refused(bare, "/src/install.sh").startswith(
        "there is another user rotator already, with the home /home/rotator"
    )


def test_another_command_of_that_name(bare: Root) -> None:
    bare.run("touch", "/usr/local/bin/rotator").check()
    assert refused(bare, "/src/install.sh") == "there is another /usr/local/bin/rotator; remove it first"


def test_two_at_once(bare: Root) -> None:
    said = bare.run("flock", "/src/install.sh", "/src/install.sh", "--remove", "--yes")
    assert said.text == "install.sh: another install.sh is at work; wait for its end\n"
