"""ttb list, signature and static: what a user sees of trains of axle loads."""

import csv
import io
import json
import math


def test_the_axles_of_a_train_are_a_file_that_can_be_read_again(ttb, tmp_path):
    listed = ttb("list", "trains", "hslm-a3", "--axles").stdout
    rows = list(csv.DictReader(io.StringIO(listed)))
    assert len(rows) == 46 and float(rows[-1]["x"]) == 397.525
    assert math.isclose(sum(float(row["load"]) for row in rows), 8280)
    (tmp_path / "mine.csv").write_text(listed)
    again = ttb("list", "trains", str(tmp_path / "mine.csv"), "--axles").stdout
    assert again == listed
    one = json.loads(ttb("list", "trains", "hslm-a3", "--json").stdout)[0]
    assert one["verified"] == "secondary" and len(one["axles"]) == 46


def test_every_kind_can_be_listed(ttb):
    for kind, name in [("trains", "ice2"), ("cars", "ice3-motor"), ("tracks", "slab"), ("spectra", "german-low"),
                       ("bridges", "cable-stayed-224"), ("load-models", "lm71")]:
        assert name in ttb("list", kind).stdout
        json.loads(ttb("list", kind, "--json").stdout)
    assert json.loads(ttb("list", "cars", "ice3-motor").stdout)["body_mass"] == 48000


def test_unknown_names_are_refused_with_what_may_have_been_meant(ttb, tmp_path):
    run = ttb("signature", "icee2", "hslm-a11", expect=2)
    assert "did you mean `ice2`" in run.stderr and "hslm-a1" in run.stderr
    run = ttb("list", "tracks", "slap", expect=2)
    assert "did you mean `slab`" in run.stderr


def test_signature_and_static_values_of_a_span(ttb, tmp_path):
    span = {"length": 25, "mass": 15e3, "bending_stiffness": 30e9}
    scenario = {
        "train": {"cars": ["ice3"], "speed": {"km_h": 250}},
        "track": {"type": "slab"},
        "bridge": {"structure": {"type": "beams", "spans": [span]}, "damping": {"type": "modal", "ratio": 0.01, "modes": 3}},
    }
    path = tmp_path / "b25.json"
    path.write_text(json.dumps(scenario))
    shown = ttb("signature", "hslm-a1", "ice2", "--bridge", str(path), "-o", str(tmp_path / "g.csv")).stdout
    assert "3.5543 Hz" in shown and "km/h" in shown and "HSLM-A" in shown
    table = {float(r["wavelength_m"]): float(r["amplitude_kn"])
             for r in csv.DictReader((tmp_path / "g.csv").open()) if r["train"] == "hslm-a1"}
    assert abs(table[18.0] - 3938.0) < 0.05
    ttb("static", str(path), "--load", "lm71", "-o", str(tmp_path / "s.csv"))
    rows = [r for r in csv.DictReader((tmp_path / "s.csv").open()) if r["place"] == "12.5"]
    found = {r["quantity"]: float(r["max"]) for r in rows}
    # Simple beam under LM71: published mid-span values.
    assert math.isclose(found["deck.moment"], 8935.2e3, rel_tol=1e-4)
    assert math.isclose(found["deck.displacement"], 18.7155e-3, rel_tol=1e-4)
    doubled = ttb("static", str(path), "--load", "lm71", "--alpha", "2").stdout
    assert f"{2 * 18.7155:.2f}" in doubled


def test_limits_and_criteria_are_listed(ttb):
    """Names, one file as it is, one criterion with its clause, and a slip of the pen."""
    assert "en1990-2002" in ttb("list", "limits").stdout
    file = json.loads(ttb("list", "limits", "en1990-2002").stdout)
    assert any(criterion["id"] == "deck-acceleration" for criterion in file["criteria"])
    [one, *_] = json.loads(ttb("list", "criteria", "deck-acceleration").stdout)
    assert one["criterion"]["quantity"] == "deck.acceleration" and one["criterion"]["clause"]
    assert "deck-acceleration" in ttb("list", "criteria", "deck-aceleration", expect=2).stderr
