"""The console blocks of the pages: each command, the machine it is for, and the output that is shown below it.

`python -m docs.blocks` counts them and lists those that the tests do not run. The prompt says the machine: `$` any
Linux computer with this program, simulated; `pi$` the Pi with its hardware, or root; `pc$` another program, or a
network.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PROMPTS = {"$": "run by the tests", "pi$": "needs the Pi, or root", "pc$": "needs another program, or a network"}
LEFT_OUT = "…"
_BLOCK = re.compile(r"^( *)```console\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)
_COMMAND = re.compile(r"^(pi\$|pc\$|\$) (.*)$")
_EXIT_CODE = re.compile(r"# exit code (\d+)")


@dataclass(frozen=True, slots=True)
class Step:
    page: str
    prompt: str
    command: str
    shown: tuple[str, ...]

    @property
    def exit_code(self) -> int:
        named = _EXIT_CODE.search(self.command)
        return int(named[1]) if named else 0


def pages() -> list[Path]:
    return [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


def steps(page: Path) -> Iterator[Step]:
    """Every command of a page, in order. A line that is neither below a prompt nor one is a ValueError."""
    name = str(page.relative_to(ROOT))
    for _, body in _BLOCK.findall(page.read_text(encoding="utf-8")):
        prompt, command, shown = "", "", list[str]()
        for line in textwrap.dedent(body).splitlines():
            if begun := _COMMAND.match(line):
                if prompt:
                    yield Step(name, prompt, command, tuple(shown))
                prompt, command, shown = begun[1], begun[2], []
            elif prompt:
                shown.append(line.rstrip())
            else:
                raise ValueError(f"{name}: no prompt before {line!r}")
        if prompt:
            yield Step(name, prompt, command, tuple(shown))


def every_step() -> list[Step]:
    return [step for page in pages() for step in steps(page)]


def matches(said: str, shown: tuple[str, ...]) -> bool:
    """Whether the output is what the page shows. `…` stands for any part of a line; alone, for any lines."""
    if not shown:
        return True
    parts = [
        r"(?:.*\n)*?" if line == LEFT_OUT else r".*".join(map(re.escape, line.split(LEFT_OUT))) + r"\n"
        for line in shown
    ]
    lines = "".join(f"{line.rstrip()}\n" for line in said.splitlines())
    return re.fullmatch("".join(parts), lines) is not None


def main() -> None:
    found = every_step()
    for prompt, meaning in PROMPTS.items():
        print(f"{sum(step.prompt == prompt for step in found):4}  {prompt:4} {meaning}")
    for step in found:
        if step.prompt != "$":
            print(f"      {step.page}: {step.prompt} {step.command}")


if __name__ == "__main__":
    main()
