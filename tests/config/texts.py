"""Short texts of configuration files, and what is wrong with one."""

from __future__ import annotations

from rotator.config.load import ConfigError, parse

FIRST = "the first [[link]]: "


def faults(text: str) -> list[str]:
    """Its mistakes; none: it can be used."""
    try:
        parse(text, "station.toml")
    except ConfigError as refused:
        return [mistake.text for mistake in refused.mistakes]
    return []


def link(protocol: str, **keys: str) -> str:
    return "\n".join(
        ("[[link]]", f'protocol = "{protocol}"', *(f'{key} = "{value}"' for key, value in keys.items()), "")
    )
