"""Runs judged by limits, and the report: `ttb report`."""

import json
import math
import re
import shutil
import subprocess

import html5lib
import numpy
import pandas
import pytest
from jsonschema import Draft202012Validator
from scenario import changed

#: First wheelset, deck and car body of R1 at 1 ms, by an independent program.
R1 = {
    ("wheel.unloading", "raw", "max", "1"): 0.23765,
    ("wheel.unloading", "butterworth-4-20Hz-zero", "max", "1"): 0.04053,
    ("wheel.unloading", "butterworth-4-20Hz-causal", "max", "1"): 0.05827,
    ("wheel.unloading", "mean-2m", "max", "1"): 0.08463,
    ("deck.acceleration", "raw", "abs-max", "mid"): 0.17649,
    ("deck.acceleration", "butterworth-4-30Hz-zero", "abs-max", "mid"): 0.11287,
    ("deck.acceleration", "butterworth-4-30Hz-causal", "abs-max", "mid"): 0.12966,
    ("body.acceleration", "raw", "abs-max", "1"): 0.11819,
    ("body.acceleration", "wb-en12299", "rms", "1"): 0.035192,
    ("body.acceleration", "wk", "rms", "1"): 0.039647,
}


@pytest.fixture(scope="module")
def folder(r1_run, tmp_path_factory):
    """A copy of R1's folder: a report writes into it."""
    copy = tmp_path_factory.mktemp("report") / "r1"
    shutil.copytree(r1_run, copy)
    return copy


@pytest.fixture(scope="module")
def page(ttb, folder):
    ttb("report", folder, "-q")
    return (folder / "report.html").read_text()


def test_r1_has_the_values_that_were_computed_independently(folder):
    """To 0.02 %, at the same step."""
    peaks = pandas.read_csv(folder / "peaks.csv", dtype={"place": str})
    found = peaks.set_index(["quantity", "filter", "statistic", "place"])["value"]
    for key, expected in R1.items():
        assert found[key] == pytest.approx(expected, rel=2e-4), key


def limits(path, limit):
    entry = {"id": "deck-acceleration", "source": "the owner's specification", "cases": [{"limit": limit}]}
    path.write_text(json.dumps({"$comment": "a project's own", "criteria": [entry]}))
    return path


def test_a_limit_just_below_the_value_turns_the_verdict(ttb, folder, tmp_path):
    """No tolerance; exit code 6 under --check alone."""
    ttb("report", folder, "-q")
    verdicts = json.loads((folder / "verdicts.json").read_text())["verdicts"]
    value = next(v["value"] for v in verdicts if v["criterion"] == "deck-acceleration" and v["value"])
    below, above = limits(tmp_path / "below.json", value * (1 - 1e-6)), limits(tmp_path / "above.json", value)
    arguments = ("report", folder, "-o", tmp_path / "report.html", "--limits")
    done = ttb(*arguments, f"en1990-2002,{below}", "--check", expect=6)
    assert re.search(r"^exceeded +deck-acceleration", done.stdout, re.M) and "1 criterion exceeded" in done.stderr
    ttb(*arguments, f"en1990-2002,{below}")
    done = ttb(*arguments, f"en1990-2002,{above}", "--check")
    assert re.search(r"^fulfilled +deck-acceleration", done.stdout, re.M)


def test_unknown_keys_and_criteria_are_refused_together(ttb, folder, tmp_path):
    """With file, path and what may have been meant."""
    path = tmp_path / "mine.json"
    entries = [{"id": "deck-acceleration", "source": "x", "limitt": 3}, {"id": "wheel-unloding", "source": "x"}]
    path.write_text(json.dumps({"criteria": entries}))
    done = ttb("report", folder, "--limits", f"en1990-2002,en14363-2016,{path}", expect=2)
    assert "$.criteria[0].limitt: unknown key" in done.stderr
    assert "unknown criterion" in done.stderr and "did you mean `wheel-unloading`" in done.stderr
    done = ttb("report", folder, "--limits", "en1990-2022", expect=2)
    assert "did you mean `en1990-2002`" in done.stderr


def test_what_is_not_judged_has_its_reason(ttb, folder):
    """N_MV needs five minutes; twist needs a run in space."""
    out = ttb("report", folder).stdout
    assert re.search(r"not judged +comfort-n-mv +N_MV of EN 12299 needs 300 s; the record has 1\.1", out)
    assert re.search(r"not judged +comfort-en12299 +a running root mean square needs 5 s; the record has 1\.1", out)
    assert re.search(r"not judged +twist +.*needs a run in space", out)
    assert re.search(r"not judged +deck-acceleration +the code makes this check with moving forces on a smooth rail", out)


def test_a_run_with_lift_off_shows_the_filtered_value_and_the_losses(ttb, examples, tmp_path):
    """Both are true, and both are printed."""
    waves = [{"amplitude": 0.8e-3, "wavelength": 1.0}]
    scenario = changed(examples / "r1.json", tmp_path / "rough.json", {"irregularity.waves": waves, "time.end": 0.6})
    ttb("run", scenario, "-q", "-o", tmp_path / "out")
    out = ttb("report", tmp_path / "out").stdout
    line = re.search(r"^fulfilled +wheel-unloading .*raw (\S+);", out, re.M)
    assert line and float(line.group(1)) == 1.0
    loss = re.search(r"^informative +contact-loss +(\S+) ms", out, re.M)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    longest = max(loss["longest"] for loss in summary["contact_losses"])
    assert float(loss.group(1)) == pytest.approx(1e3 * longest, rel=1e-3)
    assert "wheelsets lost contact" in (tmp_path / "out" / "report.html").read_text()


def test_verdicts_keep_their_schema(ttb, folder, page):
    """`ttb schema --verdicts`; every run id is a run."""
    schema = json.loads(ttb("schema", "--verdicts").stdout)
    Draft202012Validator.check_schema(schema)
    verdicts = json.loads((folder / "verdicts.json").read_text())
    Draft202012Validator(schema).validate(verdicts)
    ids = set(pandas.read_csv(folder / "peaks.csv")["run_id"])
    shown = set(re.findall(r'<code class="run">(.*?)</code>', page))
    assert shown and shown <= ids


#: B25: span, mass, bending stiffness.
L, MASS, EI = 25.0, 15e3, 30e9


@pytest.fixture(scope="module")
def b25(ttb, tmp_path_factory):
    """Three passages of HSLM-A3 over B25, with moments and shears."""
    folder = tmp_path_factory.mktemp("b25")
    n0 = math.pi / (2 * L**2) * math.sqrt(EI / MASS)
    ttb("new", "single-span", folder / "b25", "--spans", str(L), "--n0", str(n0), "--mass", str(MASS))
    ttb("sweep", folder / "b25/scenario.json", "--trains", "hslm-a3", "--speeds", "240:260:10", "--forces", "-q", "-o", folder / "out")
    return folder / "out"


def judged(folder):
    return {row["criterion"]: row for row in json.loads((folder / "verdicts.json").read_text())["verdicts"]}


def lm71_rotation():
    """Greatest rotation of an end under LM71, by its influence line s(L - s)(2L - s)/(6 L EI) and trapezoids."""
    s = numpy.linspace(0, L, 5001)
    line = s * (L - s) * (2 * L - s) / (6 * L * EI)
    area = numpy.concatenate([[0], numpy.cumsum(0.5 * (line[1:] + line[:-1]) * s[1])])
    at = lambda values, x: numpy.interp(x, s, values)
    first = numpy.arange(0, L - 4.8, 0.01)
    forces = sum(250e3 * at(line, first + 1.6 * i) for i in range(4))
    uniform = 80e3 * (at(area, numpy.clip(first - 0.8, 0, L)) + area[-1] - at(area, numpy.clip(first + 5.6, 0, L)))
    return (forces + uniform).max()


def test_static_load_models_are_judged_with_their_factors(ttb, b25, tmp_path):
    """LM71 on L 25, EI 30e9: w 18.7155 mm (assessment of B25); Φ₃ = 2.16/(√L − 0.2) + 0.73."""
    phi = 2.16 / (math.sqrt(L) - 0.2) + 0.73
    out = ttb("report", b25).stdout
    rows = judged(b25)
    assert rows["deflection"]["value"] == pytest.approx(phi * 18.7155e-3, rel=1e-4)
    assert rows["deflection"]["limit"] == pytest.approx(L / 600) and rows["deflection"]["status"] == "fulfilled"
    assert rows["comfort-deflection"]["value"] == pytest.approx(L / (phi * 18.7155e-3), rel=1e-4)
    assert re.search(r"not judged +comfort-deflection +.*your own table", out)
    assert re.search(r"not judged +deck-end +.*overhang_m", out) and re.search(r"not judged +uplift +.*by bearing: 0, 25", out)
    facts = {"overhang_m": 0.75, "maintenance": "careful", "dead_reactions_kn": {"0": 1840, "25": 1840}}
    (tmp_path / "mine.json").write_text(json.dumps({"facts": facts}))
    ttb("report", b25, "-q", "--limits", tmp_path / "mine.json")
    rows = judged(b25)
    phi = 1.44 / (math.sqrt(L) - 0.2) + 0.82
    assert rows["deck-end"]["value"] == pytest.approx(phi * 0.75 * lm71_rotation(), rel=1e-3)
    assert rows["deck-end"]["limit"] == 0.002 and rows["uplift"]["value"] == pytest.approx(1840e3, rel=1e-6)


def test_the_trains_stand_beside_the_load_model(ttb, b25):
    """(1 + φ′ + φ″) static over Φ₃·LM71: displacement at mid-span, from the values of peaks.csv."""
    ttb("report", b25, "-q")
    peaks = pandas.read_csv(b25 / "peaks.csv")
    phi = 2.16 / (math.sqrt(L) - 0.2) + 0.73
    n0 = math.pi / (2 * L**2) * math.sqrt(EI / MASS)
    irregular = 0.56 * math.exp(-((L / 10) ** 2)) + 0.5 * (L * n0 / 80 - 1) * math.exp(-((L / 20) ** 2))
    assert irregular == pytest.approx(0.01269, abs=5e-6)
    rows = peaks[(peaks.place_kind == "deck") & (peaks.statistic == "max")]
    moment = rows[rows.quantity == "deck.moment"]
    effects = (moment.value + irregular * moment.static_value) / (phi * 8935.2e3)
    found = judged(b25)["design-effect"]
    # LM71's greatest moment is that of mid-span; the train's lies beside it.
    assert found["value"] >= effects.max() * (1 - 1e-6) and found["value"] < 1.15 * effects.max()
    page = (b25 / "report.html").read_text()
    assert "Trains beside Φ·LM71" in page and "deck.shear, greatest" in page and "step halved" in page


#: What ajv knows in strict mode, and of which types each keyword speaks.
KEYWORDS = {
    "$schema $id $defs $ref $comment title description default examples enum const anyOf oneOf allOf not type deprecated": None,
    "properties required additionalProperties patternProperties propertyNames minProperties maxProperties": "object",
    "items prefixItems minItems maxItems uniqueItems contains": "array",
    "minimum maximum exclusiveMinimum exclusiveMaximum multipleOf": "number",
    "minLength maxLength pattern": "string",
}
OF_TYPE = {keyword: kind for keywords, kind in KEYWORDS.items() for keyword in keywords.split()}


def strict(schema, path="#", types=()):
    """Faults that ajv in strict mode finds: unknown keywords and formats, keywords without their type, unions of types."""
    if isinstance(schema, bool):
        return []
    told = schema.get("type", list(types))
    own = [told] if isinstance(told, str) else told
    faults = [f"{path}: unknown keyword {key}" for key in schema if key not in OF_TYPE]
    if len([kind for kind in own if kind != "null"]) > 1:
        faults.append(f"{path}: union of types {own}")
    for key in schema:
        kind = OF_TYPE.get(key)
        numbers = kind == "number" and "integer" in own
        if kind and "type" in schema and kind not in own and not numbers:
            faults.append(f"{path}: {key} without type {kind}")
        if kind and "type" not in schema and not types:
            faults.append(f"{path}: {key} without any type")
    if "prefixItems" in schema:
        count = len(schema["prefixItems"])
        if schema.get("minItems") != count or (schema.get("maxItems") != count and schema.get("items") is not False):
            faults.append(f"{path}: prefixItems need minItems and maxItems of {count}")
    for key in ("properties", "$defs", "patternProperties"):
        for name, inner in schema.get(key, {}).items():
            faults += strict(inner, f"{path}/{key}/{name}")
    for key in ("items", "additionalProperties", "not", "contains", "propertyNames"):
        if key in schema:
            faults += strict(schema[key], f"{path}/{key}", own if key == "not" else ())
    for key in ("anyOf", "oneOf", "allOf", "prefixItems"):
        for i, inner in enumerate(schema.get(key, [])):
            faults += strict(inner, f"{path}/{key}/{i}", own if key != "prefixItems" else ())
    return faults


@pytest.mark.parametrize("of", ["", "--bridge", "--summary", "--verdicts"])
def test_schemas_are_strict_and_their_examples_fit(ttb, of):
    """`npx ajv-cli compile --spec=draft2020 --strict=true` takes all four, too."""
    schema = json.loads(ttb("schema", *of.split()).stdout)
    assert strict(schema) == []
    validator = Draft202012Validator(schema)
    examples = schema.get("examples", [])
    assert examples or of == "--summary"
    for example in examples:
        validator.validate(example)


def test_the_page_is_valid_and_asks_no_network(page):
    """html5lib in strict mode."""
    html5lib.HTMLParser(strict=True).parse(page)
    assert not re.search(r"https?://|src=|@import|url\(", page)


def test_reports_of_equal_folders_differ_in_their_date_alone(ttb, folder, page, tmp_path, monkeypatch):
    """The date is a line of its own."""
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    ttb("report", folder, "-q", "-o", tmp_path / "a.html")
    other = (tmp_path / "a.html").read_text()
    assert "2023-11-14" in other and other.replace("2023-11-14", "") == re.sub(r"(?<=<dd>)\d{4}-\d\d-\d\d(?=</dd>)", "", page)


def test_a_folder_without_tables_is_refused(ttb, tmp_path):
    """With what to give instead."""
    assert "runs.csv: give the folder of a run" in ttb("report", tmp_path, expect=2).stderr


@pytest.mark.skipif(not shutil.which("chromium"), reason="chromium is not installed")
def test_a_browser_shows_the_page_without_an_error_and_prints_it(page, folder, tmp_path):
    """Headless Chromium: the verdict is there, the console is silent, the print has several pages."""
    browser = ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}"]
    url = (folder / "report.html").as_uri()
    shown = subprocess.run([*browser, "--enable-logging=stderr", "--dump-dom", url], capture_output=True, text=True, timeout=120)
    assert "Governed by" in shown.stdout and "CONSOLE" not in shown.stderr
    pdf = tmp_path / "report.pdf"
    subprocess.run([*browser, f"--print-to-pdf={pdf}", url], capture_output=True, timeout=120, check=True)
    assert len(re.findall(rb"/Type\s*/Page\b", pdf.read_bytes())) >= 2
