"""`ttb ui`: the page on this machine alone. Who is answered, what the engine says, how it ends."""

import concurrent.futures
import contextlib
import hashlib
import http.client
import json
import re
import signal
import socket
import subprocess
import time
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from conftest import program_path
from test_foreign import MAP, beam

SPAN = {"length": 24, "first_frequency": 4.5, "mass": 15000}
SCENARIO = {
    "train": {"cars": ["ice3"], "speed": {"km_h": 140}},
    "bridge": {
        "structure": {"type": "beams", "spans": [SPAN, SPAN]},
        "damping": {"type": "rayleigh", "ratio": 0.01},
    },
}


def deck(folder):
    """R1's span as an FMU in C, with names, units and signs of its own."""
    return beam(29720).write(folder)


class Page:
    """The program and its address."""

    def __init__(self, process):
        self.process = process
        address = urlsplit(process.stdout.readline().strip())
        self.port, self.path = address.port, address.path

    def ask(self, method, path, body=None, **headers):
        """Status, headers and body of an answer."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=120)
        with contextlib.closing(connection):
            headers = {name.replace("_", "-"): value for name, value in headers.items()}
            connection.request(method, path, body=body, headers=headers)
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read().decode()

    def call(self, verb, **request):
        status, _, text = self.ask("POST", f"{self.path}api/{verb}", json.dumps(request))
        assert status == 200, text
        return json.loads(text)


@contextlib.contextmanager
def started(program, *arguments, cwd=None):
    process = subprocess.Popen(
        [program, "ui", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=cwd
    )
    try:
        yield Page(process)
    finally:
        process.kill()
        process.communicate()


@pytest.fixture(scope="module")
def page():
    with started(program_path()) as page:
        yield page


def test_only_who_knows_the_address_on_this_machine_is_answered(page):
    own, verb = f"127.0.0.1:{page.port}", f"{page.path}api/about"
    assert len(page.path) == 34
    assert page.ask("GET", page.path)[0] == 200
    assert page.ask("POST", verb, "{}", Origin=f"http://{own}", Sec_Fetch_Site="same-origin")[0] == 200
    refused = [
        ("GET", "/", {}),
        ("GET", "/index.html", {}),
        ("GET", "/" + 32 * "0" + "/", {}),
        ("POST", "/api/about", {}),
        ("GET", page.path, {"Host": f"attacker.example:{page.port}"}),
        ("GET", page.path, {"Host": "127.0.0.1"}),
        ("POST", verb, {"Host": f"attacker.example:{page.port}"}),
        ("POST", verb, {"Origin": "https://attacker.example"}),
        ("POST", verb, {"Origin": "null"}),
        ("POST", verb, {"Sec_Fetch_Site": "cross-site"}),
        ("GET", verb, {}),
        ("DELETE", page.path, {}),
        ("GET", page.path + "../../etc/passwd", {}),
        ("GET", page.path + "engine.wasm/../app.js", {}),
    ]
    for method, path, headers in refused:
        status, _, text = page.ask(method, path, "{}" if method == "POST" else None, **headers)
        assert 400 <= status < 500 and len(text) < 200, (method, path, headers, status)
    # Other addresses of this machine do not listen.
    others = {address[4][0] for address in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)}
    for other in others - {"127.0.0.1"}:
        if not other.startswith("127."):
            with pytest.raises(OSError):
                socket.create_connection((other, page.port), timeout=2).close()


def test_connections_are_ended_so_that_no_other_waits_for_them(page):
    # As many at once as browsers open; the page must not be kept waiting by one that is held for later.
    def tab(_):
        with contextlib.closing(http.client.HTTPConnection("127.0.0.1", page.port, timeout=30)) as connection:
            connection.request("GET", page.path)
            answer = connection.getresponse()
            text = answer.read()
            return answer.status, answer.getheader("Connection"), len(text) == int(answer.getheader("Content-Length"))

    with concurrent.futures.ThreadPoolExecutor(12) as tabs:
        assert set(tabs.map(tab, range(200))) == {(200, "close", True)}


def test_the_page_asks_nothing_of_the_network(page):
    _, headers, index = page.ask("GET", page.path)
    assert "default-src 'none'" in headers["Content-Security-Policy"] and headers["Referrer-Policy"] == "no-referrer"
    assert '<meta name="engine" content="native">' in index
    files = re.findall(r'(?:src|href)="([^"#:]+)"', index)
    seen = set()
    while files:
        name = files.pop()
        status, headers, text = page.ask("GET", page.path + name)
        assert status == 200 and headers["X-Content-Type-Options"] == "nosniff", name
        outside = [one for one in re.findall(r"https?://[^\s\"'`]+", text) if "www.w3.org/2000/svg" not in one]
        assert not outside, (name, outside)
        seen.add(name)
        files += [one for one in re.findall(r'from "\./([^"]+)"', text) if one not in seen]
    assert {"app.js", "chart.js", "style.css", "zip.js"} <= seen


def test_no_request_waits_for_a_connection_that_says_nothing(page):
    with contextlib.ExitStack() as idle:
        for _ in range(50):
            idle.enter_context(socket.create_connection(("127.0.0.1", page.port)))
            begin = time.monotonic()
            assert page.ask("GET", page.path)[0] == 200
            assert time.monotonic() - begin < 30
    # What is no request is not answered, and harms nobody.
    for wrong in (b"\x16\x03\x01" + 100 * b"x", b"GET /" + 40000 * b"x"):
        with socket.create_connection(("127.0.0.1", page.port), timeout=10) as other:
            other.sendall(wrong + b"\r\n\r\n")
            with contextlib.suppress(ConnectionResetError):
                assert other.recv(1000) == b""
    assert page.call("about")["version"]


def test_problems_are_those_of_check_scenario(page, ttb, tmp_path):
    broken = json.loads(json.dumps(SCENARIO))
    broken["bridge"]["structure"]["spans"][1]["length"] = 24000
    broken["bridge"]["damping"]["ratio"] = "much"
    broken["brigde"] = {}
    path = tmp_path / "scenario.json"
    path.write_text(json.dumps(broken))
    told = ttb("check-scenario", "scenario.json", expect=2, cwd=tmp_path).stderr
    problems = page.call("look", text=path.read_text())["problems"]
    assert len(problems) >= 3
    # What concerns trains and speeds belongs to no place in the scenario.
    for problem in filter(lambda one: one["path"], problems):
        assert f"scenario.json: {problem['path']}: {problem['text']}" in told, problem
    for text in ("", "{", "[]", "null", '"' + "a" * 10000, '{"train":' * 5000):
        assert page.call("look", text=text)["problems"], text[:20]
    assert "cannot be read" in page.call("runs", asked={"scenari": ""})["error"]


def test_a_request_becomes_the_folder_that_a_sweep_writes_and_its_report(page, ttb, tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1767225600")
    text = json.dumps(SCENARIO)
    asked = {"scenario": text, "trains": ["hslm-a1", "hslm-a2"], "speeds": "200:240:10"}
    plan = page.call("plan", asked=asked)
    assert plan["way"] == "modal" and len(plan["runs"]) == 10
    records = page.call("runs", asked=asked, runs=plan["runs"][6:])
    records += page.call("runs", asked=asked, runs=plan["runs"][:6])
    outcome = page.call("outcome", asked=asked, records=records)
    assert outcome["charts"] and outcome["governing"] and not outcome["failed"]
    again = page.call("again", asked=asked, records=records)
    assert again and all(abs(one["difference"]) < one["allowed"] for one in again)
    made = page.call("dossier", asked=asked, records=records, compared=again, name="saved", date="2026-01-01")
    (tmp_path / "scenario.json").write_text(text)
    arguments = ["--trains", "hslm-a1,hslm-a2", "--speeds", "200:240:10", "-o", "out"]
    ttb("sweep", "scenario.json", *arguments, cwd=tmp_path)
    for name in ("runs.csv", "peaks.csv", "envelope.csv", "coupled-check.json"):
        assert made[name] == (tmp_path / "out" / name).read_text(), name
    saved = tmp_path / "saved"
    saved.mkdir()
    for name, content in made.items():
        if name not in ("report.html", "verdicts.json"):
            (saved / name).write_text(content)
    ttb("report", "saved", "-q", cwd=tmp_path)
    for name in ("verdicts.json", "report.html"):
        assert made[name] == (saved / name).read_text(), name
    # What the page sends for a report alone: extremes along the deck of judged runs.
    judged = {verdict["run_id"] for verdict in outcome["verdicts"]["verdicts"]}
    lean = [one if one["run_id"] in judged else {**one, "envelopes": []} for one in records]
    less = page.call("dossier", asked=asked, records=lean, compared=again, name="saved", date="2026-01-01")
    assert less["report.html"] == made["report.html"] and len(less["envelope.csv"]) < len(made["envelope.csv"])
    film = page.call("film", asked=asked, runs=[outcome["governing"][0]["run"]])
    deepest = max(abs(w) for row in film["displacement"] for w in row)
    largest = max(r["value"] for r in outcome["governing"] if r["quantity"] == "deck.displacement")
    assert deepest <= largest * 1.001


def test_direction_and_limits_of_a_request_are_those_of_a_sweep(page, ttb, tmp_path):
    text = json.dumps(SCENARIO)
    limits = {"names": ["tb10621-2014"]}
    asked = {"scenario": text, "trains": ["hslm-a1"], "speeds": "200", "heading": "both", "limits": limits}
    plan = page.call("plan", asked=asked)
    records = page.call("runs", asked=asked, runs=plan["runs"])
    assert len(records) == 2
    made = page.call("dossier", asked=asked, records=records, limits=limits, date="x")
    (tmp_path / "scenario.json").write_text(text)
    arguments = ["--trains", "hslm-a1", "--speeds", "200", "--heading", "both", "--limits", "tb10621-2014", "-o", "out"]
    ttb("sweep", "scenario.json", *arguments, cwd=tmp_path)
    for name in ("runs.csv", "peaks.csv", "envelope.csv"):
        assert made[name] == (tmp_path / "out" / name).read_text(), name
    there, back = (page.call("film", asked=asked, runs=[run]) for run in plan["runs"])
    assert (there["backward"], back["backward"]) == (False, True)
    # Two equal spans: what one sees first the other sees last.
    deepest = [max(abs(w) for row in film["displacement"] for w in row) for film in (there, back)]
    assert deepest[0] == pytest.approx(deepest[1], rel=1e-6)


def computed(page, asked):
    """The plan of a request and the records of its runs."""
    plan = page.call("plan", asked=asked, workers=2)
    assert "error" not in plan, plan
    return plan, page.call("runs", asked=asked, runs=plan["runs"])


def test_a_bridge_fmu_of_another_program_is_swept_as_by_the_commands(page, ttb, examples, tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    fmu = deck(tmp_path)
    asked = {"scenario": (examples / "r1.json").read_text(), "speeds": "240,250", "way": "coupled", "bridge": {"fmu": str(fmu), "map": json.dumps(MAP)}}
    plan, records = computed(page, asked)
    [bridge] = plan["bridges"]
    assert (bridge["fmu"], bridge["sha256"]) == (str(fmu), hashlib.sha256(fmu.read_bytes()).hexdigest())
    outcome = page.call("outcome", asked=asked, records=records)
    assert outcome["failed"] == [] and outcome["runs"] == 2 and len(outcome["charts"]) > 2
    files = page.call("dossier", asked=asked, records=records, name="saved", date="2023-11-14")
    (tmp_path / "saved").mkdir()
    for name, text in files.items():
        (tmp_path / "saved" / name).write_text(text)
    (tmp_path / "map.json").write_text(json.dumps(MAP))
    ttb("sweep", examples / "r1.json", "--bridge", fmu, "--map", "map.json", "--speeds", "240,250", "-o", "out", "-q", cwd=tmp_path)
    for name in ("runs.csv", "peaks.csv", "envelope.csv", "assessment.json"):
        assert (tmp_path / "out" / name).read_text() == files[name], name
    # What was saved is a sweep's folder: judged, and continued with the same FMU.
    ttb("report", "saved", "--quiet", cwd=tmp_path)
    assert (tmp_path / "saved" / "report.html").read_text() == files["report.html"]
    assert bridge["sha256"] in files["report.html"]
    ttb("campaign", "saved/plan.json", "-o", "saved", "-q", cwd=tmp_path)
    assert (tmp_path / "saved" / "peaks.csv").read_text() == files["peaks.csv"]
    assert "is an FMU" in page.call("film", asked=asked, runs=plan["runs"][:1])["error"]


def test_what_a_bridge_fmu_cannot_do_is_told_with_the_plan(page, examples, tmp_path):
    scenario, fmu = (examples / "r1.json").read_text(), deck(tmp_path)
    for wrong, told in [
        ({"bridge": {"fmu": str(tmp_path / "none.fmu")}}, "none.fmu"),
        ({"bridge": {"fmu": str(fmu), "map": "{"}}, "map.json"),
        ({"bridge": {"fmu": str(fmu), "map": json.dumps({**MAP, "force": {"name": "g[{i}]"}})}}, "g[1]"),
        ({"heading": "both"}, "heading: "),
        ({"variants": "bounds"}, "variants: "),
    ]:
        asked = {"scenario": scenario, "speeds": "250", "way": "coupled", "bridge": {"fmu": str(fmu), "map": json.dumps(MAP)}, **wrong}
        error = page.call("plan", asked=asked)["error"]
        assert told in error, error
    # An FMU that was built anew is another one.
    asked = {"scenario": scenario, "speeds": "250", "way": "coupled", "bridge": {"fmu": str(fmu), "map": json.dumps(MAP)}}
    before = page.call("plan", asked=asked)["bridges"][0]["sha256"]
    beam(20000).write(tmp_path)
    after = page.call("plan", asked=asked)["bridges"][0]["sha256"]
    assert before != after == hashlib.sha256(fmu.read_bytes()).hexdigest()


def test_an_fmu_that_was_dropped_stays_until_another_one_replaces_it(page):
    def drop(name, replaced=b""):
        status, _, answer = page.ask("POST", f"{page.path}api/fmu", name + b"\n" + replaced + b"\nbytes\n" + name)
        assert status == 200
        return json.loads(answer)

    # Kept under its name; a browser's path of it says nothing.
    first, other = (Path(drop(b"C:\\x/Deck.fmu")["path"]) for _ in range(2))
    assert first != other and first.name == "Deck.fmu" and first.read_bytes() == b"bytes\nC:\\x/Deck.fmu"
    second = Path(drop(b"New.fmu", str(first).encode())["path"])
    assert not first.parent.exists() and second.exists() and other.exists()
    # Nothing is removed that was not dropped here.
    drop(b"New.fmu", str(Path(__file__)).encode())
    assert Path(__file__).exists()
    for name in (b"", b"..", b"Deck"):
        assert "must have a name" in drop(name)["error"]


def test_runs_with_a_foreign_bridge_are_left_off(page, examples, tmp_path):
    slow = json.loads((examples / "r1.json").read_text())
    slow["time"]["step"] = 1e-6
    asked = {"scenario": json.dumps(slow), "speeds": "240,250", "way": "coupled", "bridge": {"fmu": str(deck(tmp_path)), "map": json.dumps(MAP)}}
    body = json.dumps({"asked": asked, "runs": page.call("plan", asked=asked)["runs"]})
    with concurrent.futures.ThreadPoolExecutor(1) as tab:
        begun = tab.submit(page.ask, "POST", f"{page.path}api/runs?job=deck", body)
        time.sleep(1.5)
        assert not begun.done(), begun.result()
        page.ask("POST", f"{page.path}api/cancel?job=deck")
        assert json.loads(begun.result(timeout=30)[2]) == []


def test_a_closed_tab_and_a_cancelled_job_leave_the_program_answering(page):
    slow = {**SCENARIO, "time": {"step": 1e-4}}
    asked = {"scenario": json.dumps(slow), "speeds": "100:300:10", "way": "coupled"}
    runs = page.call("plan", asked=asked)["runs"]
    body = json.dumps({"asked": asked, "runs": runs})
    head = f"POST {page.path}api/runs?job=tab HTTP/1.1\r\nHost: 127.0.0.1:{page.port}\r\nContent-Length: {len(body)}\r\n\r\n"
    with socket.create_connection(("127.0.0.1", page.port)) as tab:
        tab.sendall((head + body).encode())
        time.sleep(0.3)
    # The rest of a request that never comes.
    with socket.create_connection(("127.0.0.1", page.port)) as tab:
        tab.sendall((head + body[:10]).encode())
    begin = time.monotonic()
    assert page.ask("POST", f"{page.path}api/cancel?job=tab")[0] == 200
    assert page.call("about")["version"]
    assert time.monotonic() - begin < 30


def test_control_c_ends_it_while_it_computes(tmp_path):
    (tmp_path / "bridge.json").write_text(json.dumps({**SCENARIO, "time": {"step": 1e-4}}))
    with started(program_path(), "bridge.json", cwd=tmp_path) as page:
        assert '<meta name="scenario"' in page.ask("GET", page.path)[2]
        text = page.ask("GET", page.path + "scenario.json")[2]
        asked = {"scenario": text, "speeds": "100:300:10", "way": "coupled"}
        runs = page.call("plan", asked=asked)["runs"]
        body = json.dumps({"asked": asked, "runs": runs})
        head = f"POST {page.path}api/runs?job=x HTTP/1.1\r\nHost: 127.0.0.1:{page.port}\r\nContent-Length: {len(body)}\r\n\r\n"
        with socket.create_connection(("127.0.0.1", page.port)) as tab:
            tab.sendall((head + body).encode())
            time.sleep(0.3)
            page.process.send_signal(signal.SIGINT)
            assert page.process.wait(timeout=20) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["bridge.json"]
