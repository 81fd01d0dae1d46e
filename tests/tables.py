"""A table in one test: each of its rows is tried, and what fails says its row.

For rows that take microseconds: what pytest does around a test takes longer than any of them. They share the fixtures
of the test, so what a row does must leave nothing behind. A row that is dear, or changes what it is given, is a test
of its own: `pytest.mark.parametrize`.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable
from typing import Any

Test = Callable[..., None]


def every_row(names: str | tuple[str, ...], rows: Iterable[Any]) -> Callable[[Test], Test]:
    """As `pytest.mark.parametrize`, within the test."""
    wanted, tried = (names,) if isinstance(names, str) else names, list(rows)

    def table(test: Test) -> Test:
        @functools.wraps(test)
        def run(**fixtures: Any) -> None:
            assert tried, "a table without a row shows nothing"
            for row in tried:
                values = dict(zip(wanted, (row,) if isinstance(names, str) else row, strict=True))
                try:
                    test(**fixtures, **values)
                except BaseException as failure:
                    failure.add_note(f"in the row {values!r}")
                    raise

        signature = inspect.signature(test)
        left = [value for name, value in signature.parameters.items() if name not in wanted]
        run.__signature__ = signature.replace(parameters=left)  # type: ignore[attr-defined]
        return run

    return table
