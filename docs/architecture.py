"""`python -m docs.architecture` draws the rooms into docs/img/rooms.svg; `--figures` prints the structure's figures.

A folder after `--figures` is another copy of the source, to compare with.
Knows the source as text; it runs nothing of the program.
"""

from __future__ import annotations

import ast
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

from docs.drawings.imports import PACKAGES, circles, room_arrows, sources, within
from docs.drawings.rooms import rooms_svg

ROOT = Path(__file__).parents[1]
IMAGE = ROOT / "docs" / "img" / "rooms.svg"
CLASSES = 5


def figures(root: Path) -> Iterator[str]:
    """Markdown: what tells how easily a stranger finds the way."""
    arrows = room_arrows(root)
    yield "| | rooms | arrows between them | rooms in a circle |\n|---|---|---|---|"
    for package in PACKAGES:
        inside = within(arrows, package)
        yield f"| {package} | {len(inside)} | {sum(map(len, inside.values()))} | {len(circles(inside))} |"
    yield f"| all | {len(arrows)} | {sum(map(len, arrows.values()))} | {len(circles(arrows))} |"
    trees = {path.relative_to(root): ast.parse(path.read_text(encoding="utf-8")) for path in sources(root)}
    lengths = {path: len((root / path).read_text(encoding="utf-8").splitlines()) for path in trees}
    total = sum(lengths.values())
    longest = max(lengths, key=lambda path: lengths[path])
    yield f"\nfiles: {len(lengths)}, {total} lines; the longest: {longest}, {lengths[longest]} lines"
    functions = [
        ((node.end_lineno or node.lineno) - node.lineno + 1, f"{path}: {node.name}")
        for path, tree in trees.items()
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    ]
    lines, name = max(functions)
    yield f"the longest function: {name}, {lines} lines"
    classes = sorted((count, name) for path, tree in trees.items() for count, name in attributes(path, tree))[::-1]
    yield "most attributes: " + "; ".join(f"{name} {count}" for count, name in classes[:CLASSES])
    yield f"names of modules in import contracts: {len(contract_names(root))}"


def attributes(path: Path, tree: ast.AST) -> Iterator[tuple[int, str]]:
    """How many attributes the methods of each class give `self`. A dataclass of settings counts as none."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            given = {
                each.attr
                for each in ast.walk(node)
                if isinstance(each, ast.Attribute)
                and isinstance(each.ctx, ast.Store)
                and isinstance(each.value, ast.Name)
                and each.value.id == "self"
            }
            yield len(given), f"{node.name} ({path})"


def contract_names(root: Path) -> list[str]:
    """Every module that the import contracts name; wildcards are none, and a floor of two rooms is two."""
    table = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
    texts: list[str] = []
    for contract in table["contracts"]:
        for value in contract.values():
            texts += value if isinstance(value, list) else []
    words = [word for text in texts for word in text.replace("|", " ").replace("->", " ").replace(":", " ").split()]
    return [word for word in words if "*" not in word]


def main() -> None:
    match sys.argv[1:]:
        case []:
            IMAGE.write_text(rooms_svg(room_arrows(ROOT)), encoding="utf-8")
        case ["--figures", *folder]:
            sys.stdout.writelines(f"{line}\n" for line in figures(Path(folder[0]) if folder else ROOT))
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    main()
