"""Campaigns on real clusters of this machine alone. Not part of the usual run: TTB_CLUSTER=1 pytest test_clusters.py

Slurm: Debian's slurm-wlm and munge. Dask: `pip install dask distributed` into the environment of the tests.
"""

import json
import os
import subprocess
import sys

import pytest
from conftest import REPOSITORY

pytestmark = pytest.mark.skipif("TTB_CLUSTER" not in os.environ, reason="needs Slurm and Dask: TTB_CLUSTER=1")


def test_a_slurm_array_with_a_failed_and_a_cancelled_task_gives_the_local_result(ttb, tmp_path):
    cluster = REPOSITORY / "tests/cluster"
    command = [cluster / "slurm", cluster / "campaign_on_slurm", ttb.path, tmp_path / "campaign"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if done.returncode == 77:
        pytest.skip(done.stderr.strip())
    assert done.returncode == 0, done.stdout + done.stderr
    assert "equal to the local result: 200 runs" in done.stdout


def test_an_adaptive_study_on_dask_finds_the_resonance(ttb, tmp_path):
    pytest.importorskip("distributed", reason="pip install dask distributed")
    span = {"length": 15, "bending_stiffness": 7.694081e9, "mass": 15000}
    structure = {"type": "beams", "spans": [span]}
    bridge = {"structure": structure, "damping": {"type": "rayleigh", "ratio": 0.01}}
    scenario = tmp_path / "bridge.json"
    scenario.write_text(json.dumps({"train": {"cars": ["manchester"], "speed": {"km_h": 200}}, "bridge": bridge}))
    command = [sys.executable, REPOSITORY / "examples/dask_study.py", scenario, "hslm-a1", "280", "360", tmp_path / "study"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, env={**os.environ, "TTB": str(ttb.path)})
    assert done.returncode == 0, done.stdout + done.stderr
    # v = f1 d = 5 Hz * 18 m = 324 km/h.
    speed = float(done.stdout.splitlines()[-1].rsplit(" at ", 1)[1].split()[0])
    assert abs(speed / 324 - 1) < 0.01, done.stdout
