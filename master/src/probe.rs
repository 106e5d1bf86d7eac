//! What the trial steps before the first one mean, in the words of the map.

use ttb_coupling::probe::Probe;
use ttb_coupling::report::Side;
use ttb_coupling::verdict::{Response, Verdict};

use crate::connect::{Wire, Wiring};
use crate::error::Error;

/// Refuses what was found to be wrong.
pub fn judge(probe: &Probe, wiring: &Wiring, names: [&str; 2]) -> Result<(), Error> {
    let [train_track, bridge] = names;
    if probe.lies(Side::TrainTrack) {
        return Err(Error::Fmu(format!(
            "{train_track}: it says that it can save and restore its state (canGetAndSetFMUstate), but {}",
            repeated(probe.difference[0])
        )));
    }
    if probe.lies(Side::Bridge) {
        return Err(Error::Lies(format!(
            "{bridge}: it says that it can save and restore its state (canGetAndSetFMUstate), but {}",
            repeated(probe.difference[1])
        )));
    }
    let problems: Vec<String> = probe.responses.iter().filter_map(|response| problem(response, wiring)).collect();
    if problems.is_empty() {
        return Ok(());
    }
    let text = problems.join("\n  ");
    Err(Error::Input(format!(
        "{bridge}: trial forces on it show that its variables are not what they are taken for:\n  {text}\n\
         Factors are those of the map (their value = factor · ours in N, m, m/s, down positive; --map, docs/guide/bridges.md). \
         If all is as it should be: --no-probe."
    )))
}

fn repeated(difference: Option<f64>) -> String {
    let difference = difference.unwrap_or(f64::INFINITY);
    format!("a step repeated from a restored state differs by {difference:.1e} of what other forces change")
}

/// What is wrong with the variables of one deck, and what would mend it.
fn problem(response: &Response, wiring: &Wiring) -> Option<String> {
    let verdict = response.verdict()?;
    let n = wiring.forces.len();
    let at = response.forces.start;
    let (force, displacement, velocity) = (&wiring.forces[at], &wiring.motions[at], &wiring.motions[n + at]);
    let motion = |which: usize| if which == 0 { displacement } else { velocity };
    let mass = response.mass[0].abs();
    let seen = |mass: f64| format!("{} answers as if there were {mass:.2e} kg under each support", displacement.output);
    let mend = |key: &str, wire: &Wire, now: f64, excess: f64| {
        let (name, factor) = (if key == "force" { &wire.input } else { &wire.output }, now * excess);
        format!("\"{key}\" ({name} …): \"factor\": {factor:e}{}", unit(key, excess))
    };
    let force_factor = force.to_input.factor;
    let motion_factor = |which: usize| motion(which).from_output.factor.recip();
    let mend_motion = |which: usize, excess: f64| {
        mend(["displacement", "velocity"][which], motion(which), motion_factor(which), excess)
    };
    Some(match verdict {
        Verdict::Still(which) => {
            let name = &motion(which).output;
            format!("{name} and the like do not move at all under forces on {} and the like", force.input)
        }
        Verdict::Together(excess) => {
            let what = match (excess < 0.0, excess.abs() == 1.0) {
                (true, true) => "the deck moves against the forces".to_string(),
                (true, false) => format!("the deck moves against the forces, and {}", seen(mass)),
                _ => seen(mass),
            };
            let motions = format!("{} and {}", mend_motion(0, excess), mend_motion(1, excess));
            format!("{what}; give {}; or else {motions}", mend("force", force, force_factor, excess.recip()))
        }
        Verdict::Alone(which, excess) => {
            let (what, other) = [("displacement", "velocity"), ("velocity", "displacement")][which];
            let how = if excess == -1.0 {
                "has the opposite sign of".to_string()
            } else {
                format!("is {excess:e} times what would belong to")
            };
            format!("the {what} {how} the {other}; give {}", mend_motion(which, excess))
        }
        Verdict::OneOf(excess) => format!(
            "displacement and velocity do not belong together: in a step the displacement is {excess:e} times the integral of \
             the velocity; give {}, or {}",
            mend_motion(0, excess),
            mend_motion(1, excess.recip())
        ),
        Verdict::Against(i) => {
            format!(
                "{} moves against a force on {}, other supports do not",
                wiring.motions[i].output, wiring.forces[i].input
            )
        }
        Verdict::Mixed(i, j) => format!(
            "a force on {} moves {}, and a force on {} moves {}, as on no deck: forces and motions are not in the same order, \
             or do not begin at the same number (\"first\")",
            wiring.forces[i].input, wiring.motions[j].output, wiring.forces[j].input, wiring.motions[i].output
        ),
    })
}

/// What a factor suggests.
fn unit(key: &str, excess: f64) -> &'static str {
    match (key, excess.abs()) {
        ("force", 1e-3) => " (kN?)",
        ("displacement", 1e3) => " (mm?)",
        ("velocity", 1e3) => " (mm/s?)",
        _ => "",
    }
}
