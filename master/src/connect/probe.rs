//! What the trial steps before the first one mean, in the words of the map.

use ttb_contract::names::parse_support;
use ttb_coupling::probe::response::{CREDIBLE, Mismatch, Response};
use ttb_coupling::probe::{Probe, returns};
use ttb_scenario::spec::StructureSpec;
use ttb_session::RunError;
use ttb_session::error::Refusal;

use super::assign::Assigned;

/// What is taken for granted of the bridge's side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rules {
    /// It is a deck under a track.
    #[default]
    Deck,
    /// A deck by its names in a system structure: its mass may be that of a model.
    SystemOfDeck,
    /// Anything.
    System,
}

impl Rules {
    /// Whether a finding speaks against the run, or is only told.
    fn refuse(self, mismatch: &Mismatch) -> bool {
        match self {
            Self::Deck => true,
            Self::SystemOfDeck => !matches!(mismatch, Mismatch::Together(excess) if *excess > 0.0),
            Self::System => false,
        }
    }
}

/// Refuses what was found to be wrong; `parts` are the bridges. What is not against the rules is returned as warnings. States
/// count only where steps are repeated.
pub fn judge(
    probe: &Probe,
    train_track: &str,
    parts: &[(String, Assigned)],
    rules: Rules,
    repeats: bool,
) -> Result<Vec<String>, RunError> {
    let mut warnings = Vec::new();
    let off = |off: &f64| !returns(*off);
    match (probe.train_track.filter(off), parts.iter().zip(&probe.bridge).find(|(_, by)| off(by))) {
        (Some(by), _) if repeats => {
            return Err(RunError::Refused(Refusal::Subsystem(format!("{train_track}: {}", no_return(by)))));
        }
        (_, Some(((name, _), by))) if repeats => {
            return Err(RunError::Refused(Refusal::NoReturn(format!("{name}: {}", no_return(*by)))));
        }
        (of_track, of_bridge) => {
            let whole = of_track.map(|by| (train_track, by));
            let all = whole.into_iter().chain(of_bridge.map(|((name, _), by)| (name.as_str(), *by)));
            warnings.extend(all.map(|(name, by)| format!("{name}: {}; no step is repeated here", no_return(by))));
        }
    }
    let mut problems = Vec::new();
    for ((name, part), response) in parts.iter().zip(&probe.responses) {
        let Some(mismatch) = response.mismatch() else { continue };
        let said = part.says(&mismatch, response);
        // There is no map of a system's FMUs that could be mended.
        let said = if rules == Rules::Deck { said.as_str() } else { said.split("; give ").next().unwrap_or_default() };
        let told = format!("{name}: {said}");
        if rules.refuse(&mismatch) { problems.push(told) } else { warnings.push(told) }
    }
    if problems.is_empty() {
        return Ok(warnings);
    }
    let mend = if rules == Rules::Deck {
        "Factors are those of the map: their value = factor · ours in N, m, m/s, down positive (--map, docs/guide/bridges.md)."
    } else {
        "Signs and units can be changed by a LinearTransformation on the connections (docs/guide/ssp.md)."
    };
    Err(RunError::Refused(Refusal::Input(format!(
        "{}\nTrial forces before the first step show this. {mend} If all is as it should be: --no-probe.",
        problems.join("\n")
    ))))
}

/// As [`judge`], for the bridge of the scenario itself, which was built here: no map can be wrong. What no deck can do is
/// refused, what is only unusual is returned as a warning.
pub fn judge_own(
    probe: &Probe,
    train_track: &str,
    bridge: &StructureSpec,
    parts: &[(String, Assigned)],
    repeats: bool,
) -> Result<Vec<String>, RunError> {
    judge(&Probe { responses: Vec::new(), ..probe.clone() }, train_track, &[], Rules::Deck, repeats)?;
    let refused = |text: String| Err(RunError::Refused(Refusal::Input(text)));
    let (mass, stiffness) = match bridge {
        StructureSpec::Beams { .. } => {
            ("$.bridge.structure.spans[].mass (kg/m; given in t/m?)", "its lengths (m) and bending_stiffness (N m²)")
        }
        StructureSpec::Frame(_) => (
            "$.bridge.structure.frame.sections[].mass (kg/m; given in t/m?)",
            "modulus (N/m²), area and inertia (m², m⁴)",
        ),
        StructureSpec::FiniteElements(_) => (
            "density (kg/m³; given in t/m³?) and added_mass of $.bridge.structure.model",
            "modulus (N/m²) and coordinates (m)",
        ),
        StructureSpec::Matrices { .. } | StructureSpec::Stored => (
            "$.bridge.structure.files.mass (kg; given in t?)",
            "$.bridge.structure.files.stiffness (N/m; given in kN/m, or with lengths in mm?)",
        ),
    };
    let supports = match bridge {
        StructureSpec::Matrices { files, .. } => format!("$.bridge.structure.files.supports ({})", files.supports),
        _ => "$.bridge.structure".into(),
    };
    let mut warnings = Vec::new();
    for response in &probe.responses {
        let seen = response.mass[0];
        let number = |i: usize| parts.first().map_or_else(|| (i + 1).to_string(), |(_, part)| part.number(i, response));
        match response.mismatch() {
            None => {}
            Some(Mismatch::Still(_)) => {
                return refused(format!("the deck does not move under forces on its supports: look at {supports}"));
            }
            Some(Mismatch::Against(i)) => {
                let number = number(i);
                return refused(format!(
                    "the deck moves against a force on support {number}, at other supports it does not: look at {supports}; \
                     have weights there the wrong sign? (trial forces before the first step show this; --no-probe skips them)"
                ));
            }
            Some(Mismatch::Mixed(i, j)) => {
                return refused(format!(
                    "forces on supports {} and {} move each other's place as on no deck: look at {supports}; are rows or nodes \
                     mixed up? (trial forces before the first step show this; --no-probe skips them)",
                    number(i),
                    number(j)
                ));
            }
            Some(_) if seen < 0.0 => {
                return refused(format!(
                    "the deck moves against the forces on it: look at {mass} and {stiffness}: M or K is not positive definite \
                     (trial forces before the first step show this; --no-probe skips them)"
                ));
            }
            Some(_) if seen < LIGHTEST => {
                return refused(format!(
                    "the deck answers as if it had {seen:.2e} kg under each support, as none does: look at {mass}, and at \
                     $.time.step (s; trial forces before the first step show this; --no-probe skips them)"
                ));
            }
            Some(_) => warnings.push(format!(
                "the deck answers as if it had {seen:.2e} kg under each support, usual {:.0} to {:.0e} kg: if that is not so, look at \
                 {mass}, {stiffness} and $.time.step (s; given in ms?)",
                CREDIBLE.start, CREDIBLE.end
            )),
        }
    }
    Ok(warnings)
}

/// No deck of a railway bridge has so little under a support, kg.
const LIGHTEST: f64 = 1.0;

fn no_return(off: f64) -> String {
    format!(
        "it says that it can save and restore its state (canGetAndSetFMUstate), but a step repeated from a restored state \
         differs by {off:.1e} of what other forces change"
    )
}

impl Assigned {
    /// Variables of a series: force, displacement, velocity.
    fn first(&self, key: &str) -> (&str, f64) {
        let (ends, at) = match key {
            "force" => (&self.forces_in, 0),
            "displacement" => (&self.motions_out, 0),
            _ => (&self.motions_out, self.forces_in.names.len()),
        };
        let (name, line) = (&ends.names[at], ends.lines[at]);
        (name, if key == "force" { line.factor } else { line.factor.recip() })
    }

    /// Number of the support, and component, of the force at a position.
    fn number(&self, i: usize, response: &Response) -> String {
        let name = i.checked_sub(response.forces.start).and_then(|own| self.forces_out.names.get(own));
        match name.and_then(|name| parse_support(name)) {
            Some((support, "force" | "mean_force")) => support.to_string(),
            Some((support, component)) => format!("{support} ({component})"),
            None => (i + 1).to_string(),
        }
    }

    /// The factor that makes values `excess` times larger ones right.
    fn mend(&self, key: &str, excess: f64) -> String {
        if key == "velocity" && !self.velocities {
            return "none to velocity, which follows from displacement".into();
        }
        let (name, factor) = self.first(key);
        format!("\"{key}\" ({name} …): \"factor\": {:e}{}", factor * excess, unit(key, excess))
    }

    /// What a mismatch means for its variables.
    fn says(&self, mismatch: &Mismatch, response: &Response) -> String {
        const MOTIONS: [&str; 2] = ["displacement", "velocity"];
        let number = |i: usize| self.number(i, response);
        let seen = || format!("the deck answers as if it had {:.2e} kg under each support", response.mass[0].abs());
        match *mismatch {
            Mismatch::Still(which) => {
                let key = if self.velocities { MOTIONS[which] } else { MOTIONS[0] };
                let (motion, force) = (self.first(key).0, self.first("force").0);
                format!("{motion} and the like do not move under forces on {force} and the like")
            }
            Mismatch::Together(excess) => {
                let what = match (excess < 0.0, excess.abs() == 1.0) {
                    (true, true) => "the deck moves against the forces".to_string(),
                    (true, false) => format!("the deck moves against the forces, and {}", seen()),
                    _ => seen(),
                };
                let [d, v] = MOTIONS.map(|key| self.mend(key, excess));
                let also = if self.velocities { format!(" and {v}") } else { String::new() };
                format!("{what}; give {}; or else {d}{also}", self.mend("force", excess.recip()))
            }
            Mismatch::Alone(which, excess) => {
                let how = if excess == -1.0 {
                    "has the opposite sign of".to_string()
                } else {
                    format!("is {excess:e} times what would belong to")
                };
                format!(
                    "the {} {how} the {}; give {}",
                    MOTIONS[which],
                    MOTIONS[1 - which],
                    self.mend(MOTIONS[which], excess)
                )
            }
            Mismatch::OneOf(excess) => format!(
                "displacement and velocity do not belong together: the displacement is {excess:e} times the integral of the \
                 velocity; give {}, or {}",
                self.mend(MOTIONS[0], excess),
                self.mend(MOTIONS[1], excess.recip())
            ),
            Mismatch::Against(i) => format!(
                "the displacement at support {} goes against a force there, at other supports it does not",
                number(i)
            ),
            Mismatch::Mixed(i, j) => format!(
                "a force at support {0} moves the deck at support {1}, and one at support {1} moves it at support {0}, as on no \
                 deck: forces and motions are not in the same order, or do not begin at the same number (\"first\")",
                number(i),
                number(j)
            ),
        }
    }
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
