"""Validators of other projects find nothing wrong with either FMU, and something with a spoilt one."""

import io
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu
from lxml import etree
from spoil import DESCRIPTION, copy, replaced


def fmpy_findings(fmu):
    """`fmpy validate`."""
    return validate_fmu(str(fmu.path))


def schema_findings(fmu):
    """The XSD of FMI 2.0, as FMPy ships it."""
    schema = etree.XMLSchema(file=str(Path(fmpy.__file__).parent / "schema" / "fmi2" / "fmi2ModelDescription.xsd"))
    with zipfile.ZipFile(fmu.path) as archive:
        schema.validate(etree.parse(io.BytesIO(archive.read(DESCRIPTION))))
    return [str(error) for error in schema.error_log]


def fmutool_findings(fmu):
    """`fmutool -check` of the FMU Manipulation Toolbox: its messages other than plain information."""
    command = [Path(sys.executable).with_name("fmutool"), "-input", fmu.path, "-check"]
    done = subprocess.run(command, capture_output=True, text=True)
    said = (done.stdout + done.stderr).splitlines()
    assert any("FMU Semantic Checks" in line for line in said), said
    return [line for line in said if not line.startswith("INFO ")] + [done.returncode] * (done.returncode != 0)


VALIDATORS = [fmpy_findings, schema_findings, fmutool_findings]


@pytest.mark.parametrize("findings", VALIDATORS)
def test_a_validator_finds_nothing(any_fmu, findings):
    """Every validator accepts both FMUs without a finding."""
    assert findings(any_fmu) == []


@pytest.mark.parametrize("findings", VALIDATORS)
def test_a_validator_finds_an_input_called_an_inpout(r1, findings, tmp_path):
    """The control: each validator finds a fault that is there."""
    spoilt = copy(r1.bridge, tmp_path, {DESCRIPTION: replaced('causality="input"', 'causality="inpout"')})
    assert findings(spoilt) != []
