//! `--set`: other values for keys of a scenario.

use std::path::Path;

use ttb_scenario::{Checked, Problems, Setting, from_str_with};

const BEAMS: &str = include_str!("broken/beams.json");

fn set(settings: &[&str]) -> Result<Checked, Problems> {
    let settings: Vec<Setting> = settings.iter().map(|text| text.parse().unwrap()).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken");
    from_str_with(BEAMS, &folder, "f", &settings)
}

fn checked(settings: &[&str]) -> Checked {
    set(settings).unwrap_or_else(|problems| panic!("{problems}"))
}

#[test]
fn a_key_takes_the_place_of_the_one_that_means_the_same() {
    let speed = |setting: &str| checked(&[setting]).train_track.speed;
    assert_eq!(speed("train.speed.km_h=108"), [[0.0, 108.0 / 3.6]]);
    assert_eq!(speed("train.speed.m_s=40"), [[0.0, 40.0]]);
    assert_eq!(speed("$.train.speed.profile=[[0, 50], [1, 45]]"), [[0.0, 50.0], [1.0, 45.0]]);
    let smooth = checked(&["irregularity.type=none"]);
    assert_eq!(smooth.train_track.irregularity, ttb_scenario::spec::Profile::None);
}

#[test]
fn entries_of_lists_texts_and_keys_that_were_left_out() {
    let found = checked(&[
        "train.cars[0].body_mass=41e3",
        "bridge.structure.spans.1.mass=12e3",
        "bridge.structure.spans[1].shear_stiffness=1e10",
        "track.type=ballast-zhai",
        "track.bays=350",
        "title=a=b, with a comma",
        "output.every=5",
        "train.cars[2]=manchester",
        "train.front_wheel=85",
        "time.end=1.2",
    ]);
    assert_eq!(found.train_track.cars.len(), 3);
    assert_eq!(found.train_track.cars[0].body_mass, 41e3);
    assert_eq!((found.scenario.title.as_str(), found.scenario.output.every), ("a=b, with a comma", 5));
    let ttb_scenario::spec::StructureSpec::Beams { spans, .. } = &found.bridge.structure else { panic!("beams") };
    assert_eq!((spans[1].mass, spans[1].shear_stiffness, spans[0].mass), (12e3, Some(1e10), 20e3));
    assert_eq!(found.train_track.bays, 350);
}

#[test]
fn a_key_that_no_scenario_has_is_refused_with_what_may_have_been_meant() {
    let problems = |settings: &[&str]| set(settings).unwrap_err().to_string();
    let all = problems(&["train.sped.km_h=100", "train.speed.kmh=100", "bridge.damping.raito=0.1", "trane=1"]);
    for expected in [
        "f: --set train.sped.km_h: `train` has no key `sped`: did you mean `train.speed.km_h`?: 100",
        "`train.speed` has no key `kmh`: did you mean `train.speed.km_h`?",
        "`bridge.damping` has no key `raito`: did you mean `bridge.damping.ratio`?",
        "a scenario has no key `trane`: did you mean `train`?",
    ] {
        assert!(all.contains(expected), "{expected}\n{all}");
    }
    // a bundled car has no keys here; an entry that is not there; what is not of the type that stands there
    let all =
        problems(&["train.cars[1].body_mass=1", "bridge.points[5].x=1", "time.step.x=1", "irregularity.waves=[]"]);
    for expected in [
        "`train.cars[1]` is \"ice3-trailer\" here, which has no keys: set it as a whole",
        "`bridge.points` has 2 entries, which count from 0: there is no entry 5",
        "`time.step` has no keys inside",
        "`irregularity` of type \"spectrum\" has no key `waves`",
    ] {
        assert!(all.contains(expected), "{expected}\n{all}");
    }
}

#[test]
fn a_value_is_checked_as_if_it_stood_in_the_file() {
    let found = set(&["train.speed.km_h=fast", "bridge.damping.ratio=2"]).unwrap_err().to_string();
    assert!(found.contains("$.train.speed.km_h: must be a number: \"fast\""), "{found}");
    assert!(found.contains("$.bridge.damping.ratio: must be at most 1: 2"), "{found}");
}

#[test]
fn what_is_no_setting_is_told() {
    for wrong in ["train.speed", "=3", "a..b=1", "a[x]=1", "a[1=1", "[0]=1"] {
        assert!(wrong.parse::<Setting>().is_err(), "{wrong}");
    }
}
