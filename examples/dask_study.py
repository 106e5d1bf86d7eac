"""An adaptive study on Dask: which speed governs, asked step by step; the runs are those of `ttb sweep`.

    pip install dask distributed                  # for a cluster: dask-jobqueue
    python examples/dask_study.py bridge.json hslm-a 140 420 study

Every answer is a folder of its own, so that what was asked once is not computed again. `Client()` takes the cluster that
DASK_SCHEDULER_ADDRESS names; without one it starts two workers here. On Slurm:

    from dask_jobqueue import SLURMCluster
    cluster = SLURMCluster(cores=1, processes=1, memory="1GB", walltime="01:00:00")
    cluster.scale(jobs=16)
    client = Client(cluster)
"""

import csv
import os
import subprocess
import sys
from pathlib import Path

from distributed import Client, LocalCluster


def largest(scenario, train, speed, folder, quantity="deck.acceleration"):
    """The largest raw value of a quantity along the deck at a speed in km/h."""
    out = Path(folder) / f"{train}-{speed:g}"
    command = [os.environ.get("TTB", "ttb"), "sweep", scenario, "--trains", train, "--speeds", f"{speed:g}"]
    subprocess.run([*command, "-o", out, "-j", "1", "-q"], check=True)
    with open(out / "peaks.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["quantity"] == quantity and row["filter"] == "raw"]
    return max((abs(float(row["value"])), speed, row["train"]) for row in rows)


def study(client, scenario, train, low, high, folder, count=9, least=0.5):
    """Asks `count` speeds, then again around the best one, until they are `least` km/h apart."""
    best = None
    while True:
        step = (high - low) / (count - 1)
        speeds = [low + i * step for i in range(count)]
        futures = client.map(lambda speed: largest(scenario, train, speed, folder), speeds, retries=1)
        found = max(client.gather(futures))
        best = max(best or found, found)
        print(f"{step:6.2f} km/h: {best[0]:.3f} m/s2, {best[2]} at {best[1]:g} km/h", flush=True)
        if step <= least:
            return best
        low, high = max(low, best[1] - step), min(high, best[1] + step)


if __name__ == "__main__":
    bridge, name, first, last, place = sys.argv[1:6]
    if "DASK_SCHEDULER_ADDRESS" in os.environ:
        cluster = None
        client = Client()
    else:
        cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
        client = Client(cluster)
    with client:
        study(client, str(Path(bridge).resolve()), name, float(first), float(last), str(Path(place).resolve()))
