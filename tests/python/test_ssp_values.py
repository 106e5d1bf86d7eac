"""Values and nesting in system structures (SSP 1.0 and 2.0): bindings, mappings, systems in systems, files beside."""

import io
import json
import re
import shutil
import zipfile

import pytest
from fmpy.util import read_csv
from spoil import DESCRIPTION
from test_ssp import SSD, r1_ssp, rewritten  # noqa: F401

FACTOR = 2.0
NAMESPACES = (
    'xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" '
    'xmlns:ssm="http://ssp-standard.org/SSP1/SystemStructureParameterMapping" xmlns:ssc='
)


def parameter(name, value, kind="Real", more=""):
    return f'<ssv:Parameter name="{name}"><ssv:{kind} value="{value}" {more}/></ssv:Parameter>'


def parameter_set(*parameters, more=""):
    return f'<ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>{"".join(parameters)}</ssv:Parameters>{more}</ssv:ParameterSet>'


def inline(content, mapping="", attributes=""):
    return f"<ssd:ParameterBinding {attributes}><ssd:ParameterValues>{content}</ssd:ParameterValues>{mapping}</ssd:ParameterBinding>"


def bindings(*all_of_them):
    return f"<ssd:ParameterBindings>{''.join(all_of_them)}</ssd:ParameterBindings>"


def mapping(*entries):
    return f'<ssd:ParameterMapping><ssm:ParameterMapping version="1.0">{"".join(entries)}</ssm:ParameterMapping></ssd:ParameterMapping>'


def entry(source, target, inside="", more=""):
    return f'<ssm:MappingEntry source="{source}" target="{target}" {more}>{inside}</ssm:MappingEntry>'


def in_bridge(content):
    """At the end of the component Bridge."""

    def change(ssd):
        end = ssd.index("</ssd:Component>", ssd.index('name="Bridge"'))
        return (ssd[:end] + content + ssd[end:]).replace("xmlns:ssc=", NAMESPACES, 1)

    return change


def in_system(content):
    """Before the elements of the system."""
    return lambda ssd: ssd.replace("<ssd:Elements>", content + "<ssd:Elements>", 1).replace("xmlns:ssc=", NAMESPACES, 1)


def with_files(source, target, ssd, files):
    """`rewritten`, with further members."""
    rewritten(source, target, ssd)
    with zipfile.ZipFile(target, "a") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return target


@pytest.fixture(scope="module")
def twice_as_stiff(ttb, examples, tmp_path_factory):
    """results.csv of R1 with stiffness_factor = 2, by a map."""
    folder = tmp_path_factory.mktemp("stiff")
    ttb("build", examples / "r1.json", "-o", folder / "fmus")
    (folder / "map.json").write_text(json.dumps({"parameters": {"stiffness_factor": FACTOR}}))
    ttb("run", examples / "r1.json", "--bridge", folder / "fmus/Bridge.fmu", "--map", folder / "map.json", "-o", folder / "out")
    return (folder / "out" / "results.csv").read_bytes()


HALF = '<ssc:LinearTransformation factor="0.5" offset="0.5"/>'
SSV = parameter_set(parameter("stiffness_factor", FACTOR))
MILLI = '<ssv:Units><ssc:Unit name="ms"><ssc:BaseUnit s="1" factor="0.001"/></ssc:Unit></ssv:Units>'
WAYS = {
    "inline": (in_bridge(bindings(inline(SSV))), {}),
    "a file": (in_bridge(bindings('<ssd:ParameterBinding source="a%20b.ssv"/>')), {"a b.ssv": SSV}),
    "a later binding": (in_bridge(bindings(inline(parameter_set(parameter("stiffness_factor", 7))), inline(SSV))), {}),
    "the system's": (in_system(bindings(inline(parameter_set(parameter("Bridge.stiffness_factor", 2, "Integer"))))), {}),
    "a prefix": (in_system(bindings(inline(SSV, attributes='prefix="Bridge."'))), {}),
    "a mapping": (
        in_system(bindings(inline(parameter_set(parameter("k", 3.0)), mapping(entry("k", "Bridge.stiffness_factor", HALF))))),
        {},
    ),
    "a connector of the system": (
        lambda ssd: in_system(
            '<ssd:Connectors><ssd:Connector name="k" kind="parameter"/></ssd:Connectors>'
            + bindings(inline(parameter_set(parameter("k", FACTOR))))
        )(
            ssd.replace(
                "</ssd:Connections>",
                '<ssd:Connection startConnector="k" endElement="Bridge" endConnector="stiffness_factor"/></ssd:Connections>',
            )
        ).replace(
            '<ssd:Connectors>\n          <ssd:Connector name="support[1].force" kind="input">',
            '<ssd:Connectors><ssd:Connector name="stiffness_factor" kind="parameter"/>'
            '<ssd:Connector name="support[1].force" kind="input">',
        ),
        {},
    ),
}


@pytest.mark.parametrize("way", WAYS)
def test_a_bound_value_is_the_map_s(ttb, r1_ssp, twice_as_stiff, tmp_path, way):  # noqa: F811
    """Bit for bit, whichever way it is bound."""
    path = with_files(r1_ssp, tmp_path / "a.ssp", *WAYS[way])
    ttb("run", path, "-o", tmp_path / "out")
    assert (tmp_path / "out" / "results.csv").read_bytes() == twice_as_stiff


def nested(ssd):
    """The bridge within a system of its own, whose connectors it is seen by."""
    component = re.search(r'<ssd:Component name="Bridge".*?</ssd:Component>', ssd, flags=re.S)[0]
    connectors = re.search(r"<ssd:Connectors>.*?</ssd:Connectors>", component, flags=re.S)[0]
    inside = []
    for name, kind in re.findall(r'<ssd:Connector name="([^"]*)" kind="(\w+)"', connectors):
        one, other = f'startConnector="{name}"', f'endElement="Bridge" endConnector="{name}"'
        if kind == "output":
            one, other = f'startElement="Bridge" startConnector="{name}"', f'endConnector="{name}"'
        inside.append(f"<ssd:Connection {one} {other}/>")
    system = (
        f'<ssd:System name="Works">{connectors}<ssd:Elements>{component}</ssd:Elements>'
        f"<ssd:Connections>{''.join(inside)}</ssd:Connections></ssd:System>"
    )
    ssd = ssd.replace(component, system)
    top = ssd.rindex("<ssd:Connections>")
    return ssd[:top] + ssd[top:].replace('"Bridge"', '"Works"')


def backwards(ssd):
    """Every connection written from its input to its output."""
    pattern = r'startElement="(\w+)" startConnector="([^"]*)" endElement="(\w+)" endConnector="([^"]*)"'
    return re.sub(pattern, r'startElement="\3" startConnector="\4" endElement="\1" endConnector="\2"', ssd)


HARMLESS = {
    "nested": nested,
    "SSP 2.0": lambda ssd: ssd.replace('version="1.0"', 'version="2.0"', 1).replace("ssc:Real", "ssc:Float64"),
    "no unit": lambda ssd: re.sub(r'unit="[^"]*"', 'unit=""', ssd),
    "empty": in_system("<ssd:Connectors/><ssd:ParameterBindings/>"),
    "empty binding": in_bridge(bindings("<ssd:ParameterBinding/>", inline(parameter_set()))),
    "empty system": lambda ssd: ssd.replace("</ssd:Elements>", '<ssd:System name="S"/></ssd:Elements>'),
    "backwards": backwards,
    "encoded": lambda ssd: ssd.replace("resources/Bridge.fmu", "./resources/%42ridge.fmu"),
    "a unit": in_bridge(bindings(inline(parameter_set(parameter("step_size", 1.0, more='unit="ms"'), more=MILLI)))),
    "no unit there": in_bridge(bindings(inline(parameter_set(parameter("mass_factor", 1.0, more='unit="ms"'), more=MILLI)))),
    "a value for nobody": in_system(bindings(inline(parameter_set(parameter("Bridge.nothing", 1.0))))),
}


@pytest.mark.parametrize("how", HARMLESS)
def test_what_changes_nothing_changes_nothing(ttb, r1_ssp, r1_run, tmp_path, how):  # noqa: F811
    """Bit for bit the run of the scenario."""
    done = ttb("run", rewritten(r1_ssp, tmp_path / "a.ssp", HARMLESS[how]), "-o", tmp_path / "out")
    assert (tmp_path / "out" / "results.csv").read_bytes() == (r1_run / "results.csv").read_bytes()
    assert ("no variable has the name Bridge.nothing" in done.stderr) == (how == "a value for nobody")
    assert ("since mass_factor has no unit" in done.stderr) == (how == "no unit there")


def test_a_document_by_itself_names_files_around_it_and_elsewhere(ttb, r1_ssp, r1_run, tmp_path):  # noqa: F811
    """A .ssd with relative paths, one of which leads upwards, and a file: URI; the summary lists what was read."""
    with zipfile.ZipFile(r1_ssp) as archive:
        archive.extractall(tmp_path / "a b")
    (tmp_path / "system").mkdir()
    text = (tmp_path / "a b" / SSD).read_text()
    text = text.replace("resources/Bridge.fmu", "../a%20b/resources/Bridge.fmu")
    text = text.replace("resources/TrainTrack.fmu", f"file://{tmp_path}/a%20b/resources/TrainTrack.fmu")
    (tmp_path / "system" / "mine.ssd").write_text(text)
    ttb("run", tmp_path / "system" / "mine.ssd", "-o", tmp_path / "out")
    assert (tmp_path / "out" / "results.csv").read_bytes() == (r1_run / "results.csv").read_bytes()
    roles = [read["role"] for read in json.loads((tmp_path / "out" / "summary.json").read_text())["inputs"]]
    assert sorted(roles) == ["fmu", "fmu", "system"]


def test_the_resolved_system_gives_the_same_results_from_anywhere(ttb, r1_ssp, twice_as_stiff, tmp_path):  # noqa: F811
    """Flattened, values inside; its own resolved copy is the same bytes."""
    change, files = WAYS["a mapping"]
    ttb("run", with_files(r1_ssp, tmp_path / "a.ssp", lambda ssd: change(nested(ssd).replace("Bridge.st", "Works.Bridge.st")), files), "-o", tmp_path / "out", expect=0)
    assert (tmp_path / "out" / "results.csv").read_bytes() != twice_as_stiff  # the mapping named Bridge, which is in Works
    ttb("run", with_files(r1_ssp, tmp_path / "b.ssp", change, files), "-o", tmp_path / "b")
    resolved = shutil.copy(tmp_path / "b" / "system.resolved.ssp", tmp_path / "moved.ssp")
    ttb("run", resolved, "-o", tmp_path / "c")
    assert (tmp_path / "c" / "results.csv").read_bytes() == twice_as_stiff
    with zipfile.ZipFile(resolved) as first, zipfile.ZipFile(tmp_path / "c" / "system.resolved.ssp") as second:
        assert [first.read(name) for name in first.namelist()] == [second.read(name) for name in second.namelist()]


REFUSED = {
    "a number for nothing": (in_bridge(bindings(inline(parameter_set(parameter("support[1].velocity", 1.0))))), "cannot be set"),
    "a text": (in_bridge(bindings(inline(parameter_set(parameter("mass_factor", "heavy", "String"))))), 'the text "heavy"'),
    "a metre": (
        in_bridge(
            bindings(
                inline(
                    parameter_set(
                        parameter("step_size", 1.0, more='unit="m"'),
                        more='<ssv:Units><ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit></ssv:Units>',
                    )
                )
            )
        ),
        "step_size: its unit is one of another quantity",
    ),
    "an item": (
        in_bridge(bindings(inline(parameter_set(parameter("input_meaning", "middle", "Enumeration"))))),
        "its enumeration has no item middle; there are mean (1), end (2)",
    ),
    "sub-steps": (lambda ssd: ssd.replace('step="0.001"', 'step="0.001" substeps="10"'), "bind step_size = 0.0001"),
    "a circle": (
        lambda ssd: ssd.replace("</ssd:Elements>", '<ssd:Component name="X" source="no.fmu"/></ssd:Elements>'),
        "3 components; there must be two",
    ),
}


def test_all_problems_of_values_come_at_once(ttb, r1_ssp, tmp_path):  # noqa: F811
    """Those of values, of sources and of the number of components, each with its place."""

    def all_of_them(ssd):
        for change, _ in REFUSED.values():
            ssd = change(ssd)
        return ssd.replace(NAMESPACES, "xmlns:ssc=").replace("xmlns:ssc=", NAMESPACES, 1)

    def merged(ssd):
        """One element ParameterBindings."""
        ssd = all_of_them(ssd)
        return ssd.replace("</ssd:ParameterBindings><ssd:ParameterBindings>", "")

    path = rewritten(r1_ssp, tmp_path / "a.ssp", merged)
    said = ttb("run", path, "-o", tmp_path / "out", expect=2).stderr
    for name in ("a number for nothing", "a text", "a metre", "an item", "a circle"):
        assert REFUSED[name][1] in said, said
    assert "the archive has no file no.fmu" in said and not (tmp_path / "out").exists()


@pytest.mark.parametrize("name", REFUSED)
def test_a_value_that_cannot_be_is_refused_with_its_place(ttb, r1_ssp, tmp_path, name):  # noqa: F811
    """Exit code 2."""
    change, said = REFUSED[name]
    path = rewritten(r1_ssp, tmp_path / "a.ssp", change)
    assert said in ttb("run", path, "-o", tmp_path / "out", expect=2).stderr


def test_an_item_is_known_by_its_name(ttb, r1_ssp, tmp_path):  # noqa: F811
    """TrainTrack's input_meaning by name, through a table; the resolved copy has its number."""
    table = '<ssc:EnumerationMappingTransformation><ssc:MapEntry source="last" target="end"/></ssc:EnumerationMappingTransformation>'
    content = bindings(
        inline(parameter_set(parameter("m", "last", "Enumeration")), mapping(entry("m", "TrainTrack.input_meaning", table)))
    )
    ttb("run", rewritten(r1_ssp, tmp_path / "a.ssp", in_system(content)), "-o", tmp_path / "out")
    with zipfile.ZipFile(tmp_path / "out" / "system.resolved.ssp") as archive:
        assert re.search(r'name="input_meaning">\s*<ssv:Integer value="3"/>', archive.read(SSD).decode())


def plain(fmu):
    """An FMU without units, whose forces and motions have names that tell nothing."""
    target = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(fmu)) as old, zipfile.ZipFile(target, "w") as new:
        for member in old.namelist():
            content = old.read(member)
            if member == DESCRIPTION:
                content = re.sub(r' unit="[^"]*"', "", content.decode()).encode()
            new.writestr(member, content)
    return target.getvalue()


def test_a_system_without_units_runs_and_says_what_was_assumed(ttb, r1_ssp, r1_run, tmp_path):  # noqa: F811
    """No unit, no annotation: the first component that can repeat steps is taken for the side that sends forces."""
    members = {f"resources/{name}.fmu": plain for name in ("TrainTrack", "Bridge")}

    def bare(ssd):
        ssd = re.sub(r"<ssd:Annotations>.*?</ssd:Annotations>", "", ssd, flags=re.S)
        return re.sub(r' unit="[^"]*"', "", ssd)

    done = ttb("run", rewritten(r1_ssp, tmp_path / "a.ssp", bare, members), "-o", tmp_path / "out")
    assert "TrainTrack is taken for the side that gives forces to Bridge" in done.stderr
    values, expected = read_csv(tmp_path / "out" / "results.csv"), read_csv(r1_run / "results.csv")
    name = "point[mid].displacement"
    assert abs(values[name] - expected[name]).max() <= 1e-5 * abs(expected[name]).max()
