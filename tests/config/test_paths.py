"""Keys that name a file: a folder alone is a mistake in the file, and no failure while the box starts."""

from __future__ import annotations

import pytest

from rotator.config.load import ConfigError, parse

LINK = '[[link]]\nprotocol = "{protocol}"\n'
KEYS = {
    "state.path": "[state]\npath = {path}\n",
    "monitor.path": "[monitor]\npath = {path}\n",
    "sim.world": "[sim]\nworld = {path}\n",
    "pty": LINK.format(protocol="gs232b") + "pty = {path}\n",
    "file": LINK.format(protocol="wsjtx") + "file = {path}\n",
}


@pytest.mark.parametrize("path", ["/", ".", "..", "run/", "run/.", "../..", " ", "run/ "])
@pytest.mark.parametrize("key", KEYS)
def test_a_folder_alone(key: str, path: str) -> None:
    with pytest.raises(ConfigError, match=f'{key}.*"{path}" is a folder: name the file in it'):
        parse(KEYS[key].format(path=f'"{path}"'), "x")


@pytest.mark.parametrize("key", KEYS)
def test_a_character_that_cannot_be_seen(key: str) -> None:
    with pytest.raises(ConfigError, match=f"{key}.*cannot be seen"):
        parse(KEYS[key].format(path='"a\\u0000b"'), "x")


@pytest.mark.parametrize("path", ["state.json", "run/gs 232", "/tmp/ü/☃", "~x", "...", ".hidden"])
@pytest.mark.parametrize("key", KEYS)
def test_a_file(key: str, path: str) -> None:
    parse(KEYS[key].format(path=f'"{path}"'), "x")
