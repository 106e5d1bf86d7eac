"""Rules of the FMU Compliance Checker and of docs/guide/fmus.md that validators leave out or that are worth a second reading.

Checked here on the bare XML: attributes of the root, identifiers, unique names and references, admissible combinations
of causality, variability and initial, start values, bounds, units, types, and the whole ModelStructure.
"""

import re
import zipfile
from collections import Counter

import pytest
from lxml import etree
from spoil import DESCRIPTION

# FMI 2.0.4, section 2.2.7: (causality, variability) → admissible `initial`, the default first; None: must be absent.
COMBINATIONS = {
    ("input", "continuous"): [None],
    ("output", "continuous"): ["calculated", "exact"],
    ("parameter", "fixed"): ["exact"],
}


@pytest.fixture
def root(any_fmu):
    with zipfile.ZipFile(any_fmu.path) as archive:
        return etree.fromstring(archive.read(DESCRIPTION))


@pytest.fixture
def variables(root):
    return root.findall("ModelVariables/ScalarVariable")


def test_the_root_says_version_and_guid_in_the_standards_form_and_no_date(root):
    """fmiVersion exactly 2.0; the GUID a registry GUID; nobody has asked for a date."""
    assert root.get("fmiVersion") == "2.0"
    assert re.fullmatch(r"\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\}", root.get("guid"))
    assert root.get("generationDateAndTime") is None
    assert root.find("ModelExchange") is None


def test_a_date_that_is_asked_for_is_in_the_files_and_a_wrong_one_is_refused(ttb, examples, tmp_path, monkeypatch):
    """SOURCE_DATE_EPOCH, of reproducible-builds.org; 1709210096 is 2024-02-29T12:34:56Z by GNU date."""
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1709210096")
    ttb("export-ssp", examples / "r1.json", "-o", tmp_path / "r1.ssp")
    with zipfile.ZipFile(tmp_path / "r1.ssp") as archive:
        assert {entry.date_time for entry in archive.infolist()} == {(2024, 2, 29, 12, 34, 56)}
        structure = etree.fromstring(archive.read("SystemStructure.ssd"))
        with zipfile.ZipFile(archive.open("resources/Bridge.fmu")) as fmu:
            assert {entry.date_time for entry in fmu.infolist()} == {(2024, 2, 29, 12, 34, 56)}
            description = etree.fromstring(fmu.read(DESCRIPTION))
    assert {root.get("generationDateAndTime") for root in (structure, description)} == {"2024-02-29T12:34:56Z"}
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    assert "SOURCE_DATE_EPOCH" in ttb("build", examples / "r1.json", "-o", tmp_path, expect=2).stderr


def test_the_capabilities_are_those_a_master_with_roll_back_needs(root, any_fmu):
    """The capabilities that the guide names are declared."""
    kind = root.find("CoSimulation")
    assert re.fullmatch(r"[A-Za-z_]\w*", kind.get("modelIdentifier"))
    needed = ["canHandleVariableCommunicationStepSize", "canInterpolateInputs", "canGetAndSetFMUstate", "canSerializeFMUstate"]
    assert [kind.get(name) for name in needed] == ["true"] * 4
    assert kind.get("providesDirectionalDerivative") == ("true" if any_fmu.identifier == "Bridge" else "false")
    assert kind.get("canBeInstantiatedOnlyOncePerProcess", "false") == "false"


def test_names_and_references_are_unique_and_names_have_no_comma(variables):
    """FMPy's CSV reader mislabels columns after a comma."""
    names = Counter(v.get("name") for v in variables)
    references = Counter(v.get("valueReference") for v in variables)
    assert max(names.values()) == 1 and max(references.values()) == 1
    assert [name for name in names if "," in name or name != name.strip()] == []


def test_causality_variability_and_initial_fit_together(variables):
    """The table of section 2.2.7; only Reals are continuous."""
    for v in variables:
        admissible = COMBINATIONS[v.get("causality"), v.get("variability")]
        assert v.get("initial", admissible[0]) in admissible, v.get("name")
        assert v.get("variability") != "continuous" or v[0].tag == "Real", v.get("name")


def test_start_values_are_there_where_they_must_and_within_bounds(variables):
    """Section 2.2.7: inputs, parameters and exact variables have one, calculated variables none."""
    for v in variables:
        calculated = v.get("causality") == "output" and v.get("initial") != "exact"
        assert (v[0].get("start") is None) == calculated, v.get("name")
        if v[0].tag in ("Real", "Integer") and not calculated:
            least, most = float(v[0].get("min", "-inf")), float(v[0].get("max", "inf"))
            assert least <= float(v[0].get("start")) <= most, v.get("name")


def test_units_and_types_in_use_are_defined_and_all_defined_ones_are_used(root, variables):
    """Sections 2.2.2 and 2.2.3."""
    assert {v[0].get("unit") for v in variables} - {None} == {unit.get("name") for unit in root.findall("UnitDefinitions/Unit")}
    types = {kind.get("name") for kind in root.findall("TypeDefinitions/SimpleType")}
    assert {v[0].get("declaredType") for v in variables} - {None} == types
    for kind in root.findall("TypeDefinitions/SimpleType/Enumeration"):
        values = [int(item.get("value")) for item in kind]
        assert values == list(range(1, len(values) + 1))
    for v in variables:
        assert v[0].tag != "Enumeration" or v[0].get("declaredType"), v.get("name")


def test_the_model_structure_lists_every_output_once_in_order(root, variables):
    """Section 2.2.8: 1-based, ascending; no derivatives; InitialUnknowns are the calculated outputs only."""
    structure = root.find("ModelStructure")
    outputs = [i for i, v in enumerate(variables, 1) if v.get("causality") == "output"]
    calculated = [i for i in outputs if variables[i - 1].get("initial") != "exact"]
    assert [int(unknown.get("index")) for unknown in structure.find("Outputs")] == outputs
    assert [int(unknown.get("index")) for unknown in structure.iterfind("InitialUnknowns/Unknown")] == calculated
    assert structure.find("Derivatives") is None


def test_only_the_support_forces_of_the_track_declare_feed_through(root, variables):
    """docs/guide/fmus.md: absent dependencies mean all inputs, "" none; feed-through on both sides would be an algebraic loop."""
    for unknown in root.find("ModelStructure/Outputs"):
        name = variables[int(unknown.get("index")) - 1].get("name")
        feeds_through = re.fullmatch(r"support\[\d+\]\.(force|force_y|moment_x)", name)
        assert unknown.get("dependencies") == (None if feeds_through else ""), name


def test_the_default_experiment_begins_at_zero_and_holds_whole_steps(root):
    """startTime < stopTime, stepSize positive."""
    experiment = root.find("DefaultExperiment")
    stop, step = float(experiment.get("stopTime")), float(experiment.get("stepSize"))
    assert float(experiment.get("startTime")) == 0 < step < stop
    assert abs(stop / step - round(stop / step)) < 1e-9
