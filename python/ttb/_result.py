"""The results of a run, read when they are asked for."""

from __future__ import annotations

import csv
import html
import json
import tempfile
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Union

if TYPE_CHECKING:
    import pandas

SEPARATORS = {"comma": ",", "semicolon": ";", "tab": "\t"}
SHOWN = 12


@dataclass(frozen=True)
class Extreme:
    """A least or greatest value."""

    value: float
    """In the unit of the peak."""
    time: float
    """When, s."""
    x: Optional[float] = None
    """Where, m, for what has a place."""


@dataclass(frozen=True)
class Peak:
    """Both extremes of a variable."""

    name: str
    unit: str
    min: Extreme
    max: Extreme
    estimated_error: Optional[float] = None
    """How far both may be off for the steps' sake, where the program has chosen the steps."""

    @property
    def amount(self) -> float:
        """The larger of |min| and |max|."""
        return max(abs(self.min.value), abs(self.max.value))

    def __float__(self) -> float:
        return self.amount


class Result:
    """What a run has left in its folder.

    A folder that was not asked for by ``output`` is removed with this object: keep the object as long as you use files in it.
    """

    def __init__(self, folder: Union[str, Path], keep: Optional[tempfile.TemporaryDirectory[str]] = None) -> None:
        self.folder = Path(folder)
        """Where the files are."""
        self._keep = keep

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json: status, peaks, iterations, seconds, every file read with its hash; see docs/guide/results.md."""
        read: dict[str, Any] = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        return read

    @cached_property
    def scenario(self) -> dict[str, Any]:
        """The scenario with all defaults and the steps that were taken; empty for a system structure."""
        path = self.folder / "scenario.resolved.json"
        return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}

    @cached_property
    def peaks(self) -> dict[str, Peak]:
        """Extremes of every recorded variable by its name."""

        def extreme(found: dict[str, Any]) -> Extreme:
            return Extreme(found["value"], found["time"], found.get("x"))

        found = self.summary["peaks"].items()
        return {
            name: Peak(name, peak["unit"], extreme(peak["min"]), extreme(peak["max"]), peak.get("estimated_error"))
            for name, peak in found
        }

    @property
    def warnings(self) -> list[str]:
        """What was noticed."""
        return list(self.summary["warnings"])

    @property
    def fmus(self) -> dict[str, Path]:
        """The FMUs that were built for the run, by name: ``TrainTrack``, ``Bridge``."""
        return {path.stem: path for path in sorted(self.folder.glob("*.fmu"))}

    @property
    def svg(self) -> str:
        """Deck, cars and wheels over time, as a picture."""
        return (self.folder / "results.svg").read_text(encoding="utf-8")

    def _form(self) -> tuple[str, str]:
        """Separator and decimal sign of the tables."""
        form = self.scenario.get("output", {}).get("csv", {})
        return SEPARATORS[form.get("separator", "comma")], "," if form.get("decimal") == "comma" else "."

    def columns(self) -> dict[str, list[float]]:
        """results.csv as lists of numbers by column; the first is ``time``."""
        separator, decimal = self._form()
        with open(self.folder / "results.csv", newline="", encoding="utf-8") as file:
            rows = csv.reader(file, delimiter=separator)
            names = next(rows)
            values = zip(*([float(text.replace(decimal, ".")) for text in row] for row in rows))
            return {name: list(column) for name, column in zip(names, values)}

    def frame(self) -> pandas.DataFrame:
        """results.csv as a DataFrame over time (needs pandas)."""
        try:
            import pandas
        except ImportError as missing:
            raise ImportError("frames need pandas (pip install pandas); columns() does without") from missing
        separator, decimal = self._form()
        # The bits that were written; pandas 3 and later read them so without being told.
        exact = int(pandas.__version__.split(".")[0]) >= 3 or decimal != "."
        options: dict[str, Any] = {} if exact else {"float_precision": "round_trip"}
        return pandas.read_csv(self.folder / "results.csv", sep=separator, decimal=decimal, index_col="time", **options)

    def __repr__(self) -> str:
        return f"<ttb.Result {self.summary['status']}: {self.summary['title']}, to {self.summary['reached_s']} s, in {self.folder}>"

    def _repr_html_(self) -> str:
        """For notebooks: the picture, and peaks of what engineers look at first."""
        of_bridge = [peak for name, peak in self.peaks.items() if name.startswith(("point[", "deck"))]
        rows = "".join(
            f"<tr><td>{html.escape(peak.name)}</td><td>{peak.min.value:.5g}</td><td>{peak.max.value:.5g}</td>"
            f"<td>{html.escape(peak.unit)}</td></tr>"
            for peak in (of_bridge or list(self.peaks.values()))[:SHOWN]
        )
        head = "<tr><th>variable</th><th>least</th><th>greatest</th><th>unit</th></tr>"
        title, status = html.escape(self.summary["title"]), html.escape(self.summary["status"])
        picture = self.svg if (self.folder / "results.svg").is_file() else ""
        return f"<p><b>{title}</b> ({status}, {self.summary['reached_s']} s)</p>{picture}<table>{head}{rows}</table>"
