"""Train–track–bridge co-simulation from Python: runs, sweeps and checks by the program ``ttb``.

    import ttb
    result = ttb.run("r1.json", **{"train.speed.km_h": 280})
    result.frame()["point[mid].acceleration"].plot()      # with pandas
    result.peaks["point[mid].acceleration"].amount        # m/s²

Pure Python over the program, which comes in the same package; pandas is needed for frames alone. All quantities are in SI
units and have the names of the FMUs' variables. The guide page docs/guide/python.md has more.
"""

from ._check import check, schema
from ._errors import Failed, Problem, Problems
from ._program import program
from ._result import Extreme, Peak, Result
from ._run import run
from ._sweep import Sweep, sweep

__version__ = "0.1.0"
__all__ = ["Extreme", "Failed", "Peak", "Problem", "Problems", "Result", "Sweep", "check", "program", "run", "schema", "sweep"]
