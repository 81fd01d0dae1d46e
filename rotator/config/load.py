"""Reads a configuration file, or a shipped one, and lists all its mistakes at once, in the order of the file.

The keys are in the model. `mistakes` finds what is wrong; here are only the reasons why there is nothing to read.
"""

from __future__ import annotations

import difflib
from importlib.resources import files
from pathlib import Path

from rotator.config import migrations, toml_text
from rotator.config.mistake import ConfigError, Mistake
from rotator.config.model import Config
from rotator.exchange.foreign import TooMuchError
from rotator.store.plain import NoPlainFileError

__all__ = ["SIMULATED", "ConfigError", "Mistake", "load", "parse", "profiles", "shipped"]

SIMULATED = "simulated"
"""The name of the configuration that runs without a file."""
SIMULATED_FILE = Path(__file__).with_name("simulated.toml")
"""Its file, for a program that needs one."""
_MAKES = "`rotator config --ask --to {}` writes it from your answers; `rotator config --list` shows the shipped files"


def load(path: Path | None) -> Config:
    """The configuration in the file, or the shipped simulated station's. Raises ConfigError."""
    if path is None:
        return parse(shipped(), "the shipped configuration")
    try:
        text = toml_text.read(path)
    except OSError as fault:
        raise ConfigError(str(path), [Mistake(_unreadable(path, fault))]) from fault
    if is_empty(text):
        raise ConfigError(str(path), [Mistake(f"is empty: {_MAKES.format(path)}")])
    return parse(text, str(path))


def is_empty(text: str) -> bool:
    """Whether the text of a file says nothing: it has only comments and empty lines."""
    return not any(row.strip() and not row.strip().startswith("#") for row in text.splitlines())


def shipped(name: str = SIMULATED) -> str:
    """The text of a shipped configuration. Capitals do not matter. Raises ConfigError with the list of names."""
    name = _as_shipped(name.lower())
    if name == SIMULATED:
        return SIMULATED_FILE.read_text(encoding="utf-8")
    if name not in profiles():
        known = [SIMULATED, *profiles()]
        near = difflib.get_close_matches(name, known, n=1, cutoff=0.6)
        meant = f" Did you mean {near[0]}?" if near else ""
        raise ConfigError(name, [Mistake(f"there is no such configuration.{meant} There are: {', '.join(known)}")])
    return files("rotator.config").joinpath("profiles", f"{name}.toml").read_text(encoding="utf-8")


def _as_shipped(name: str) -> str:
    """`g-5500` is what stands on the rotor: a name that differs by no letter and no digit is the shipped one."""
    plain = {_letters(each): each for each in (SIMULATED, *profiles())}
    return plain.get(_letters(name), name)


def _letters(name: str) -> str:
    return "".join(character for character in name if character.isalnum())


def profiles() -> list[str]:
    """The names of the shipped configurations for real rotors."""
    texts = files("rotator.config").joinpath("profiles").iterdir()
    return sorted(text.name.removesuffix(".toml") for text in texts if text.name.endswith(".toml"))


def parse(text: str, name: str) -> Config:
    """The checked configuration in a TOML text. `name` stands in the errors. Raises ConfigError."""
    try:
        return Config.model_validate(migrations.values(text))
    except TooMuchError as fault:
        raise ConfigError(name, [Mistake(str(fault))]) from fault
    except ValueError as first:
        from rotator.config.mistakes import mistakes_in  # noqa: PLC0415 - only a file with a mistake needs it

        raise ConfigError(name, mistakes_in(text)) from first


def _unreadable(path: Path, fault: OSError) -> str:
    match fault:
        case FileNotFoundError():
            near = difflib.get_close_matches(path.stem, _names_in(path.parent), n=1, cutoff=0.6)
            meant = f"did you mean {path.with_name(near[0] + '.toml')}? " if near else ""
            return f"there is no such file: {meant}{_MAKES.format(path)}"
        case IsADirectoryError():
            return f"is a folder: name the file in it, such as {path / 'rotator.toml'}"
        case NoPlainFileError(strerror=str(reason)):
            return reason
        case PermissionError():
            return "you may not read it: put sudo before the command, or let its owner give you the right (chmod +r)"
        case _:
            return f"cannot be read: {fault.strerror or fault}"


def _names_in(folder: Path) -> list[str]:
    try:
        return [each.stem for each in folder.iterdir() if each.suffix == ".toml"]
    except OSError:
        return []
