"""The page in Chromium, by clicks and typing. Opt-in: it needs Chromium, and for the engine in the browser `tools/web`.

TTB_BROWSER=1 python -m pytest test_page.py; pictures go into the folder $TTB_PICTURES, axe-core is taken from $TTB_AXE.
"""

import functools
import hashlib
import http.server
import json
import os
import threading
import time
from pathlib import Path

import pytest
from browser import CHROMIUM, Browser
from conftest import REPOSITORY, program_path
from test_foreign import MAP
from test_ui import deck, started

pytestmark = pytest.mark.skipif(
    not (os.environ.get("TTB_BROWSER") and CHROMIUM), reason="opt-in: TTB_BROWSER=1, Chromium"
)
DIST = REPOSITORY / "dist" / "web"
# Where others compute, too, a time says nothing.
QUIET = os.getloadavg()[0] < 0.5 * os.cpu_count()


def longest(seconds):
    """How long a computation may take, s: $TTB_SECONDS, or as promised on a quiet machine."""
    return float(os.environ.get("TTB_SECONDS", seconds if QUIET else "inf"))


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@pytest.fixture(scope="module", params=["wasm", "native"])
def address(request):
    """Where the page is, from a plain file server or from the program."""
    if request.param == "native":
        with started(program_path()) as page:
            yield f"http://127.0.0.1:{page.port}{page.path}"
        return
    if not (DIST / "engine.wasm").is_file():
        pytest.skip("tools/web has not built dist/web: the standard library for wasm32-unknown-unknown is needed")
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=DIST))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()


@pytest.fixture
def browser(tmp_path):
    made = Browser(tmp_path / "profile")
    yield made
    made.close()


@pytest.fixture
def clean(browser, address):
    """The page, opened; afterwards no complaint and no request to anywhere else."""
    browser.open(address)
    yield browser
    assert browser.complaints() == []
    own = tuple(address.split("/", 3)[:3])
    outside = [url for url in browser.requests() if not url.startswith(("/".join(own), "blob:", "data:", "about:"))]
    assert outside == []


def computed(browser, seconds):
    return browser.wait("document.documentElement.dataset.computed", seconds)


def two_spans(browser):
    """The typed fields of two spans of 24 m under HSLM-A, from an empty page."""
    fields = {"#count": "2", "#length": "24", "#first_frequency": "4.5", "#mass": "15000", "#ratio": "1", "#speeds": "140:420:5"}
    for selector, text in fields.items():
        browser.type(selector, text)
    return len(fields)


def test_from_an_empty_page_to_curve_verdict_and_report(clean):
    assert two_spans(clean) <= 8
    clean.wait("document.querySelector('#sketch svg')")
    begin = time.monotonic()
    clean.click("#compute")
    computed(clean, 30)
    assert clean.evaluate("document.querySelectorAll('#charts svg').length") >= 2
    assert "criteria" in clean.evaluate("document.querySelector('#verdict').textContent")
    clean.evaluate("window.open = () => null")
    clean.click("#report")
    clean.wait("document.documentElement.dataset.report", 30)
    took = time.monotonic() - begin
    print(f"curve, verdict and report after {took:.2f} s")
    assert clean.evaluate("document.querySelector('#done').textContent").startswith("570 runs")
    assert took < longest(3)


def ice_3(browser):
    """The example with vehicles, from the list of examples."""
    browser.choose("#example", "ice3")
    browser.wait("document.querySelector('#sketch svg') && document.querySelector('#speeds').value === '200:300:5'")


def test_vehicles_on_an_irregular_track(clean):
    ice_3(clean)
    begin = time.monotonic()
    clean.click("#compute")
    computed(clean, 400)
    took = time.monotonic() - begin
    print(f"21 speeds of an ICE 3 after {took:.1f} s")
    assert clean.evaluate("document.querySelector('#done').textContent").startswith("21 runs")
    assert took < longest(30)
    clean.click("#show")
    clean.wait("document.querySelector('#film input[type=range]')", 60)
    assert clean.evaluate("document.querySelectorAll('#film .chart svg[role=img]').length") == 1


def test_a_cancelled_computation_ends_at_once_and_the_page_goes_on(clean):
    ice_3(clean)
    clean.click("#compute")
    clean.wait("/ of 21 runs/.test(document.querySelector('#done').textContent)")
    time.sleep(0.5)
    clean.evaluate("document.querySelector('#cancel').addEventListener('click', () => { window.begun = performance.now(); }, true);"
                   "new MutationObserver(() => { window.ended ??= performance.now(); }).observe(document.querySelector('#done'), { childList: true });"
                   "window.ended = undefined")
    clean.click("#cancel")
    clean.wait("document.querySelector('#done').textContent === 'Cancelled.'", 10)
    assert clean.evaluate("window.ended - window.begun") < 200
    clean.type("#speeds", "200")
    clean.click("#compute")
    computed(clean, 60)


def open_by_link(clean):
    """The page anew, by the link that it makes of its scenario."""
    clean.click("#link")
    clean.wait("location.hash.startsWith('#s=')")
    linked = clean.evaluate("location.href")
    clean.send("Page.navigate", url="about:blank")
    time.sleep(0.2)
    clean.open(linked)


def test_a_bridge_fmu_is_run_at_every_speed_or_refused_with_the_reason(clean, address, examples, tmp_path):
    told = "document.querySelector('#bridge-fmu-told').textContent"
    if clean.evaluate("document.querySelector('meta[name=engine]').content") != "native":
        assert clean.evaluate("document.querySelector('#bridge-fmu').disabled")
        assert "ttb ui" in clean.evaluate(told)
        return
    scenario = json.loads((examples / "r1.json").read_text())
    state = json.dumps({"scenario": scenario, "request": {"way": "coupled", "speeds": "90,100"}})
    fragment = clean.evaluate(f"import('./files.js').then((files) => files.fragment({state}))")
    clean.send("Page.navigate", url="about:blank")
    time.sleep(0.2)
    clean.open(address + fragment)
    fmu = deck(tmp_path)
    clean.click("#foreign summary")
    clean.type("#bridge-fmu", str(fmu))
    clean.type("#bridge-map", json.dumps(MAP))
    clean.type("#speeds", "100,90")
    clean.click("#compute")
    computed(clean, 120)
    assert clean.evaluate("document.querySelector('#done').textContent").startswith("2 runs")
    assert hashlib.sha256(fmu.read_bytes()).hexdigest() in clean.evaluate("document.querySelector('#bridge-file').textContent")
    assert clean.evaluate("document.querySelectorAll('#charts svg').length") >= 1
    assert "an FMU the motion" in clean.evaluate("document.querySelector('#film').textContent")
    clean.evaluate("window.open = () => null")
    clean.click("#report")
    clean.wait("Number(document.documentElement.dataset.report) > 10000")
    assert f"--bridge {fmu} --map map.json" in clean.evaluate("document.querySelector('#command').textContent")
    # What cannot be: an FMU cannot be turned round.
    clean.choose("#heading", "both")
    clean.click("#compute")
    clean.wait("document.querySelector('#problems').textContent.includes('the places of an FMU')")


def test_a_browser_without_vectors_is_told_what_would_do(browser, address):
    """As one of before 2021 answers the probe."""
    browser.send("Page.addScriptToEvaluateOnNewDocument", source="WebAssembly.validate = () => false")
    for _ in range(2):  # The first page of a new window comes in between.
        browser.send("Page.navigate", url=address)
        time.sleep(0.5)
    if browser.evaluate("document.querySelector('meta[name=engine]').content") == "native":
        browser.wait("document.documentElement.dataset.ready === 'true'")
        return
    told = browser.wait("/There is no engine/.test(document.querySelector('#engine').textContent) && document.querySelector('#engine').textContent")
    assert "128 bits" in told and "Safari from 16.4" in told and "ttb ui" in told
    assert browser.evaluate("document.querySelector('#compute').disabled")
    assert not [url for url in browser.requests() if url.endswith("engine.wasm")] and browser.complaints() == []


def test_direction_and_limits_are_chosen_by_clicks(clean):
    two_spans(clean)
    clean.type("#trains", "hslm-a1")
    clean.type("#speeds", "200")
    clean.choose("#heading", "both")
    clean.click("details.section summary")
    ticked = "[...document.querySelectorAll('input[name=limits]:checked')].map((box) => box.value)"
    for name in clean.evaluate(ticked):
        clean.click(f"input[name=limits][value='{name}']")
    clean.click("input[name=limits][value='tb10621-2014']")
    assert clean.evaluate(ticked) == ["tb10621-2014"]
    clean.click("#compute")
    computed(clean, 60)
    assert clean.evaluate("document.querySelector('#done').textContent").startswith("2 runs")
    runs = clean.evaluate("[...document.querySelectorAll('#run option')].map((option) => option.textContent)")
    assert [name for name in runs if ":" not in name] == ["hslm-a1, 200 km/h", "hslm-a1 backward, 200 km/h"]
    sources = clean.evaluate("[...document.querySelectorAll('#outcome tbody td[title]')].map((cell) => cell.title)")
    assert sources and all("2014" in source for source in sources), sources
    told = clean.evaluate("document.querySelector('#command').textContent")
    assert "--heading both" in told and told.endswith("--limits tb10621-2014 -o out")
    # A link brings the choices back.
    open_by_link(clean)
    assert clean.evaluate(ticked) == ["tb10621-2014"] and clean.evaluate("document.querySelector('#heading').value") == "both"


def test_a_computation_twice_gives_the_same_files(clean):
    asked = {"scenario": json.dumps(B25), "trains": ["hslm-a"], "speeds": "200:220:5", "refine": True}
    script = f"""import('./engine.js').then(async (of) => {{
        const [engine, asked] = [await of.connect(), {json.dumps(asked)}];
        const once = async (shuffled) => {{
            const plan = await engine.call('plan', {{ asked }});
            if (shuffled) plan.runs.reverse();
            const records = await of.compute(engine, asked, plan, () => {{}}, new AbortController().signal);
            return engine.call('dossier', {{ asked, records, name: 'twice', date: '2026-01-01' }});
        }};
        return [await once(false), await once(true)];
    }})"""
    one, other = clean.evaluate(script)
    assert {"runs.csv", "peaks.csv", "report.html"} <= set(one) and one == other


def test_problems_stand_at_their_fields_in_the_words_of_the_check(clean, ttb, tmp_path):
    two_spans(clean)
    for selector, key, text, typed in [("#mass", "mass", "heavy", "heavy"), ("#length", "length", "24000", 24000)]:
        clean.type(selector, text)
        clean.wait(f"document.querySelector('{selector}').getAttribute('aria-invalid') === 'true'")
        shown = clean.evaluate(f"document.querySelector('{selector}-told').textContent")
        span = {"length": 24, "first_frequency": 4.5, "mass": 15000, key: typed}
        scenario = {
            "train": {"cars": ["ice3"], "speed": {"km_h": 140}},
            "bridge": {
                "structure": {"type": "beams", "spans": [span, span]},
                "damping": {"type": "rayleigh", "ratio": 0.01},
            },
        }
        path = tmp_path / "scenario.json"
        path.write_text(json.dumps(scenario))
        told = ttb("check-scenario", path, expect=2).stderr
        assert shown and shown in told, (shown, told)
        clean.type(selector, {"mass": "15000", "length": "24"}[key])
    clean.type("#speeds", "420:140")
    clean.click("#compute")
    clean.wait("document.querySelector('#speeds').getAttribute('aria-invalid') === 'true'")
    assert "must rise" in clean.evaluate("document.querySelector('#speeds-told').textContent")
    # What only the plan finds stays, though a check was about to begin when Compute was clicked.
    clean.type("#trains", "ice2")
    clean.type("#speeds", "300:320:10")
    clean.click("#compute")
    shown = "document.querySelector('#problems').textContent"
    clean.wait(f"{shown}.includes('greatest speed is below')")
    time.sleep(0.5)
    assert "greatest speed is below" in clean.evaluate(shown)


def test_the_whole_task_can_be_done_by_keyboard(clean):
    def forward(to):
        for _ in range(60):
            clean.key("Tab")
            if clean.focus() == to:
                return
        raise AssertionError(f"{to} is not reached by the Tab key")

    for name, text in [("count", "2"), ("length", "24"), ("first_frequency", "4.5"), ("mass", "15000"), ("ratio", "1"), ("speeds", "200:240:20")]:
        forward(name)
        clean.key("a", modifiers=2)
        clean.keys(text)
    clean.key("Enter")
    computed(clean, 60)
    forward("report")
    clean.evaluate("window.open = () => null")
    clean.key("Enter")
    clean.wait("document.documentElement.dataset.report", 30)
    for _ in range(60):
        clean.key("Tab")
        if clean.evaluate("document.activeElement.matches('#charts svg')"):
            break
    clean.key("ArrowRight")
    assert "km/h" in clean.evaluate("document.querySelector('#charts .read').textContent")


def test_a_link_and_a_file_bring_the_scenario_back(clean, address):
    two_spans(clean)
    open_by_link(clean)
    shown = clean.evaluate("['count', 'length', 'first_frequency', 'mass', 'ratio', 'speeds', 'trains'].map((id) => document.getElementById(id).value)")
    assert shown == ["2", "24", "4.5", "15000", "1", "140:420:5", "hslm-a"]


B25 = {
    "train": {"cars": ["ice3"], "speed": {"km_h": 250}},
    "bridge": {
        "structure": {"type": "beams", "spans": [{"length": 25, "bending_stiffness": 30e9, "mass": 15000}]},
        "damping": {"type": "modal", "ratio": 0.01, "modes": 3},
    },
}


@pytest.mark.parametrize("case", ["r1", "b25", "default"])
def test_the_browser_computes_the_peaks_of_the_program(clean, address, examples, case):
    """To the last bit: sines and powers come from one library, and sums have one order."""
    if case == "b25":
        asked = {"scenario": json.dumps(B25), "trains": ["hslm-a3"], "speeds": "250"}
    else:
        asked = {"scenario": (examples / f"{case}.json").read_text(), "way": "coupled"}
    script = "import('./engine.js').then((of) => of.connect()).then(async (engine) => {{ const asked = {}; const plan = await engine.call('plan', {{ asked }}); return engine.call('runs', {{ asked, runs: plan.runs }}); }})"
    [mine] = clean.evaluate(script.format(json.dumps(asked)))
    with started(program_path()) as page:
        [program] = page.call("runs", asked=asked, runs=page.call("plan", asked=asked)["runs"])
    assert len(mine["peaks"]) > 5
    for record in (mine, program):
        del record["seconds"]
    assert mine == program


AXE = Path(os.environ.get("TTB_AXE", "axe.min.js"))


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_is_accessible_and_fits_three_widths(clean, scheme, tmp_path):
    pictures = Path(os.environ.get("TTB_PICTURES", tmp_path))
    clean.scheme(scheme)
    clean.send("Page.reload")
    time.sleep(0.3)
    clean.wait("document.documentElement.dataset.ready === 'true'")
    two_spans(clean)
    clean.type("#speeds", "140:420:10")
    clean.click("#compute")
    computed(clean, 60)
    clean.wait("document.querySelector('#film svg')", 60)
    for width in (360, 820, 1440):
        clean.size(width, 900)
        time.sleep(0.4)
        assert clean.evaluate("document.documentElement.scrollWidth") <= width
        clean.picture(pictures / f"page-{width}-{scheme}.png")
    if AXE.is_file():
        clean.send("Runtime.evaluate", expression=AXE.read_text())
        found = clean.evaluate("axe.run(document, { resultTypes: ['violations'] }).then((all) => all.violations.map((one) => [one.id, one.impact, one.nodes.slice(0, 3).map((node) => node.html)]))")
        assert [one for one in found if one[1] in ("serious", "critical")] == [], found
        print("axe:", found)
