"""What a call of the program may end with."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Optional, Sequence

if TYPE_CHECKING:
    from ._result import Result

CODES = {1: "findings", 2: "bad input", 3: "not converged", 4: "an FMU failed", 5: "files", 6: "a limit is exceeded", 7: "some runs failed"}


class Failed(RuntimeError):
    """The program has ended with an exit code other than 0.

    ``code``: the exit code, as ``ttb --help`` explains it. ``result``: what a run has computed before it failed, if anything.
    """

    def __init__(self, message: str, code: int, result: Optional[Result] = None) -> None:
        super().__init__(message)
        self.code = code
        self.result = result

    @property
    def kind(self) -> str:
        """The exit code in words; ``ended`` for a run that a wheel off its rail has ended."""
        ended = self.result is not None and self.result.summary.get("status") == "ended"
        return "ended" if ended else CODES.get(self.code, f"exit code {self.code}")


@dataclass(frozen=True)
class Problem:
    """One rule that an input does not keep."""

    file: str
    """The file, or ``scenario`` for one that was given as a dictionary."""
    path: str
    """Where in it, such as ``$.train.cars[2].body_mass``; empty for the file as a whole."""
    rule: str
    """The rule."""
    value: str
    """What was found instead."""
    suggestion: Optional[str] = None
    """What may have been meant."""

    def __str__(self) -> str:
        place = ": ".join(part for part in (self.file, self.path) if part)
        meant = f" (did you mean `{self.suggestion}`?)" if self.suggestion else ""
        return ": ".join(part for part in (place, self.rule, self.value) if part) + meant


class Problems(Failed, ValueError):
    """All problems of an input at once, in ``problems``; the message has a line for each."""

    def __init__(self, problems: Sequence[Problem]) -> None:
        super().__init__("\n".join(map(str, problems)), 2)
        self.problems = list(problems)


def message(errors: str) -> str:
    """What the program has said of its end: its standard error without warnings."""
    texts = re.split(r"^ttb: ", errors, flags=re.MULTILINE)
    texts = [text for text in texts if text.strip() and not text.startswith(("warning: ", "chosen: "))]
    return texts[-1].strip() if texts else errors.strip()
