//! Runs over one prepared track and bridge give the bits of runs that are built alone.

use ttb_scenario::Checked;
use ttb_scenario::step::Steps;
use ttb_session::{Case, Column, Plan, Table};
use ttb_tests::{example, sides};

type Prepared = ttb_session::Prepared<ttb_train_track::Prepared, ttb_bridge::Prepared>;

fn run(sides: &mut ttb_session::Sides<ttb_train_track::TrainTrack, ttb_bridge::Bridge>, checked: &Checked) -> Table {
    let mut table = Table::default();
    let plan = Plan { axis: Case::of(checked).axis(), wanted: &Column::has_extremes, clock: &|| 0.0 };
    sides.run(&plan, &mut [&mut table]).expect("run");
    table
}

#[test]
fn runs_of_other_speeds_steps_and_ends_share_one_track_and_one_bridge() {
    let r1 = example("r1.json");
    let mut faster = r1.clone();
    (faster.train_track.speed[0][1], faster.train_track.end, faster.bridge.end) = (80.0, 0.5, 0.5);
    let mut finer = faster.clone();
    finer.set_steps(Steps { step: 5e-4, substeps: 1 });
    let mut prepared = Prepared::new(&r1).expect("prepared");
    let before = std::sync::Arc::clone(prepared.bridge());
    for checked in [&r1, &faster, &finer, &faster] {
        let shared = run(&mut prepared.sides(checked).expect("sides"), checked);
        let alone = run(&mut sides(checked), checked);
        assert!(shared.values.len() > 10 && shared.time == alone.time);
        for (column, (shared, alone)) in shared.columns.iter().zip(shared.values.iter().zip(&alone.values)) {
            let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
            assert!(bits(shared) == bits(alone), "{column}");
        }
    }
    assert!(std::sync::Arc::ptr_eq(&before, prepared.bridge()));
    assert_eq!(before.factorisations(), 2, "one for each step size");
}

#[test]
fn another_bridge_is_prepared_anew() {
    let r1 = example("r1.json");
    let mut prepared = Prepared::new(&r1).expect("prepared");
    let before = std::sync::Arc::clone(prepared.bridge());
    let heavier = ttb_tests::r1_with(60e3, 1e-3);
    let checked = Checked { train_track: r1.train_track.clone(), ..heavier };
    prepared.sides(&checked).expect("sides");
    assert!(!std::sync::Arc::ptr_eq(&before, prepared.bridge()));
}
