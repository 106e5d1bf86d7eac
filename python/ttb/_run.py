"""``ttb.run``."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any, Iterable, Mapping, Optional, Union

from ._check import checked, failure
from ._errors import Failed, Problem, Problems
from ._program import AnyPath, call
from ._result import Result
from ._scenario import Scenario, file, settings


def run(
    scenario: Scenario = None,
    changes: Optional[Mapping[str, Any]] = None,
    *,
    output: Optional[AnyPath] = None,
    options: Iterable[AnyPath] = (),
    **more: Any,
) -> Result:
    """Runs a scenario, and gives its results.

    ``scenario``: path of a scenario or of a system structure (.ssp), a dictionary with what stands in a scenario file, or
    nothing for the bundled one. Files that a dictionary names are looked for in the current folder.

    ``changes``: other values for keys of the scenario, in the units of the keys, as in
    ``{"train.speed.km_h": 280, "bridge.structure.spans[0].mass": 12e3}``. They may be given by name as well, with two
    underscores for a dot: ``train__speed__km_h=280``.

    ``output``: folder for the results; without it a temporary one, which is removed with the Result.

    ``options``: further options of `ttb run`, as in ``["--bridge", "theirs.fmu", "--map", "map.json"]``.

    Raises Problems if the input has problems, Failed if the run fails; ``Failed.result`` has what was computed by then.
    """
    keep = None
    if output is None:
        keep = tempfile.TemporaryDirectory(prefix="ttb-python-")
        output = keep.name
    arguments = settings({**(changes or {}), **more})
    with file(scenario) as path:
        given = [path] if path else []
        done = call(["run", *given, *arguments, "-o", output, "--quiet", *options])
        if done.code == 2 and not (path or "").endswith((".ssp", ".ssd")):
            told = checked(path, isinstance(scenario, Mapping), arguments)
            if told["problems"]:
                raise Problems([Problem(**problem) for problem in told["problems"]])
    folder = Path(output)
    result = Result(folder, keep) if (folder / "summary.json").is_file() else None
    if done.code == 0 and result is not None:
        return result
    failed = failure(done)
    # A run that was refused leaves the folder, and with it results of an earlier run, as they were.
    is_of_this_run = result is not None and result.summary["status"] not in ("ok", "running")
    raise failed if isinstance(failed, Problems) else Failed(str(failed), failed.code, result if is_of_this_run else None)
