"""`ttb interoperability`: counts about a folder, and nothing of what lies in it."""

import re
import shutil

from spoil import DESCRIPTION, copy
from test_ssp import SSD, r1_ssp, rewritten  # noqa: F401


def test_a_folder_becomes_a_page_of_counts(ttb, r1, r1_ssp, tmp_path):  # noqa: F811
    """A good FMU, one of FMI 3, no FMU, a system that runs and one that does not."""
    folder = tmp_path / "some models"
    (folder / "secret").mkdir(parents=True)
    shutil.copy(r1.bridge.path, folder / "secret" / "good.FMU")
    other = {DESCRIPTION: lambda b: b.replace(b'fmiVersion="2.0"', b'fmiVersion="3.0"').replace(b"ttb", b"tool | x")}
    copy(r1.bridge, tmp_path, other).path.rename(folder / "other.fmu")
    (folder / "no.fmu").write_text("no archive")
    shutil.copy(r1_ssp, folder / "r1.ssp")
    rewritten(r1_ssp, folder / "broken.ssp", lambda ssd: ssd.replace("resources/Bridge.fmu", "resources/Absent.fmu"))
    ttb("interoperability", folder, "-o", tmp_path / "page.md", "--limit", "120")
    page = (tmp_path / "page.md").read_text()
    assert "3 FMUs, of which 1 run; 2 system structures, of which 1 run" in page
    assert re.search(r"^\| ttb [\d.]+, FMI 2.0 \| 1 \| 1 \| none \|$", page, flags=re.M), page
    assert re.search(r"^\| tool \\\| x [\d.]+, FMI 3.0 \| 1 \| 0 \| fmi-version 1 \|$", page, flags=re.M), page
    assert "| the archive has no file … | 1 |" in page
    for name in ("secret", "good", "Absent", "Bridge", SSD):
        assert name not in page, name
    page = ttb("interoperability", folder, "--files", "--limit", "120").stdout
    assert "| secret/good.FMU |" in page


def test_a_folder_without_models_is_told(ttb, tmp_path):
    """Exit code 2; one that is not there 5."""
    assert "neither an FMU" in ttb("interoperability", tmp_path, expect=2).stderr
    ttb("interoperability", tmp_path / "absent", expect=5)
