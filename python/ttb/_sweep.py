"""``ttb.sweep``: many runs at a time."""

from __future__ import annotations

import html
import os
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable, Iterator, Mapping, Optional, Sequence, Union

from ._errors import Failed
from ._program import WAIT, AnyPath, end_calls
from ._result import Result
from ._run import run
from ._scenario import Scenario, plain

if TYPE_CHECKING:
    import pandas


class Sweep(Sequence[Union[Result, Failed]]):
    """Many runs: ``sweep[i]`` is the Result of ``sweep.changes[i]``, or the Failed that it ended with."""

    def __init__(self, changes: list[dict[str, Any]], outcomes: list[Union[Result, Failed]]) -> None:
        self.changes = changes
        self.outcomes = outcomes

    def __len__(self) -> int:
        return len(self.outcomes)

    def __getitem__(self, at: Any) -> Any:
        return self.outcomes[at]

    def __iter__(self) -> Iterator[Union[Result, Failed]]:
        return iter(self.outcomes)

    @property
    def failed(self) -> list[Failed]:
        """The runs that failed."""
        return [outcome for outcome in self.outcomes if isinstance(outcome, Failed)]

    def rows(self, *names: str) -> list[dict[str, Any]]:
        """A row a run: the changes, then the larger of |min| and |max| of each variable named, of all if none is named. A run
        that failed has None there, and its message as ``error``."""
        return [self._row(changes, outcome, names) for changes, outcome in zip(self.changes, self.outcomes)]

    @staticmethod
    def _row(changes: dict[str, Any], outcome: Union[Result, Failed], names: tuple[str, ...]) -> dict[str, Any]:
        if isinstance(outcome, Failed):
            return {**changes, **dict.fromkeys(names), "error": str(outcome)}
        peaks = outcome.peaks
        unknown = [name for name in names if name not in peaks]
        if unknown:
            raise KeyError(f"no peak of {', '.join(unknown)}; there are {', '.join(peaks)}")
        return {**changes, **{name: peaks[name].amount for name in names or peaks}}

    def frame(self, *names: str) -> pandas.DataFrame:
        """:meth:`rows` as a DataFrame (needs pandas)."""
        try:
            import pandas
        except ImportError as missing:
            raise ImportError("frames need pandas (pip install pandas); rows() does without") from missing
        return pandas.DataFrame(self.rows(*names))

    def __repr__(self) -> str:
        return f"<ttb.Sweep of {len(self)} runs, {len(self.failed)} failed>"

    def _repr_html_(self) -> str:
        """For notebooks: the changes, and how each run ended."""
        keys = list(dict.fromkeys(key for changes in self.changes for key in changes))
        ends = [f"{o.kind}: {o}" if isinstance(o, Failed) else o.summary["status"] for o in self.outcomes]
        cells = [[*(str(changes.get(key, "")) for key in keys), end] for changes, end in zip(self.changes, ends)]
        rows = ["".join(f"<td>{html.escape(cell)}</td>" for cell in row) for row in cells]
        head = "".join(f"<th>{html.escape(key)}</th>" for key in [*keys, "status"])
        return f"<table><tr>{head}</tr>{''.join(f'<tr>{row}</tr>' for row in rows)}</table>"


def sweep(
    scenario: Scenario,
    changes: Union[Mapping[str, Sequence[Any]], Iterable[Mapping[str, Any]]],
    *,
    workers: Optional[int] = None,
    output: Optional[AnyPath] = None,
    options: Iterable[AnyPath] = (),
) -> Sweep:
    """Runs a scenario with many changes, several runs at a time.

    ``changes``: values for keys, as in ``{"train.speed.km_h": range(140, 421, 20), "bridge.damping.ratio": [0.01, 0.02]}``:
    every combination is run, the last key changing fastest. Or a list with the changes of each run.

    ``workers``: runs at a time; without it as many as there are processors for this process.

    ``output``: folder for the results, a folder 0001, 0002 … a run; without it each Result has a temporary one.

    A run that fails stands in the Sweep as its exception; it does not end the others. For very many runs, trains at many speeds
    or a cluster the commands `ttb sweep` and `ttb campaign` are made: docs/guide/sweeps.md.
    """
    if isinstance(changes, Mapping):
        keys = list(changes)
        every = [dict(zip(keys, plain(values))) for values in product(*changes.values())]
    else:
        every = [dict(one) for one in changes]
    options = list(options)

    def one(i: int) -> Union[Result, Failed]:
        folder = None if output is None else Path(output) / f"{i + 1:04}"
        try:
            return run(scenario, every[i], output=folder, options=options)
        except Failed as failed:
            return failed

    with ThreadPoolExecutor(workers or processors()) as pool:
        futures = [pool.submit(one, i) for i in range(len(every))]
        waiting = set(futures)
        try:
            while waiting:
                done, waiting = wait(waiting, timeout=WAIT, return_when=FIRST_EXCEPTION)
                for future in done:
                    future.result()
            return Sweep(every, [future.result() for future in futures])
        except BaseException:
            for future in futures:
                future.cancel()
            # More than once: a call may be about to begin.
            while waiting:
                end_calls()
                waiting = wait(waiting, timeout=0.2).not_done
            raise


def processors() -> int:
    """Processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
