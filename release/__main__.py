"""`python -m release`: builds what is handed out, into the folder dist. Each command says what it made.

Knows the commands. `make dist`, `make deb` and `make lock` call them.
"""

from __future__ import annotations

import hashlib
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import click

from release import archives, deb, environment, lock
from release.source import ReleaseError, Source

PROJECT = Path(__file__).parent.parent
INTO = click.option("--into", type=click.Path(path_type=Path, file_okay=False), default=Path("dist"), show_default=True)
SOURCE = click.option(
    "--source", type=click.Path(path_type=Path, file_okay=False, exists=True), default=PROJECT, hidden=True
)


@click.group()
def cli() -> None:
    """Build what is handed out."""


@cli.command(name="archives")
@INTO
@SOURCE
@click.option("--twice", is_flag=True, help="Build them twice, and fail unless they are the same.")
def make_archives(into: Path, source: Path, twice: bool) -> None:
    """The sdist and the wheel."""
    project = Source.at(source)
    made = archives.build(project, into)
    if twice:
        compare(made, lambda again: archives.build(project, again))
    tell(made)


@cli.command(name="deb")
@INTO
@SOURCE
@click.option("--arch", "archs", multiple=True, type=click.Choice(list(environment.MACHINES)), required=True)
@click.option("--twice", is_flag=True, help="Build it twice, and fail unless it is the same.")
def make_deb(into: Path, source: Path, archs: tuple[str, ...], twice: bool) -> None:
    """The Debian package of each architecture that is named, and the list of what is in it (CycloneDX).

    Any architecture can be built on any.
    """
    project = Source.at(source)
    with tempfile.TemporaryDirectory() as scratch:
        _, wheel = archives.build(project, Path(scratch))
        made = debs(project, wheel, into, archs)
        if twice:
            compare(made, lambda again: debs(project, wheel, again, archs))
    tell(made)


def debs(project: Source, wheel: Path, into: Path, archs: tuple[str, ...]) -> tuple[Path, ...]:
    into.mkdir(parents=True, exist_ok=True)
    return tuple(path for arch in archs for path in deb.build(project, wheel, into, arch))


@cli.command(name="lock")
def make_lock() -> None:
    """Write anew which version of each package goes into the Debian package: the newest that pyproject.toml allows."""
    click.echo(lock.write(Source.at(PROJECT)))


def compare(made: tuple[Path, ...], build: Callable[[Path], tuple[Path, ...]]) -> None:
    with tempfile.TemporaryDirectory() as scratch:
        for one, other in zip(made, build(Path(scratch)), strict=True):
            if digest(one) != digest(other):
                raise ReleaseError(f"{one.name}: a second build gave other bytes")


def tell(made: tuple[Path, ...]) -> None:
    for path in made:
        click.echo(f"{digest(path)}  {path}")


def digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


if __name__ == "__main__":
    try:
        cli()
    except ReleaseError as fault:
        sys.exit(f"release: {fault}")
