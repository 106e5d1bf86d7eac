//! `ttb signature`: resonance lengths of trains, whether HSLM-A covers them, and what they mean for a bridge.

use std::fmt::Write;

use ttb_passage::{ModalBridge, Settings};
use ttb_scenario::Checked;
use ttb_scenario::spec::StructureSpec;
use ttb_trains::signature::{SHORTEST, uncovered};
use ttb_trains::{ForceTrain, Signature as Of, find, find_all};

use crate::cli::Signature;
use crate::error::Error;
use crate::files;
use crate::prepare::fmus;

/// Longest wavelength that is looked at, m, and resonance lengths that are shown of a train.
const LONGEST: f64 = 40.0;
const SHOWN: usize = 6;
/// Damping where nobody says otherwise, of 1.
const DAMPING: f64 = 0.01;

/// What of a bridge matters here.
struct Known {
    /// First frequency, Hz.
    frequency: f64,
    /// Damping ratio of the first mode, of 1.
    damping: f64,
    /// Length, m, and mass, kg/m, of the one simple span that the LIR estimate is for.
    simple: Option<[f64; 2]>,
}

/// The command.
pub fn signature(arguments: &Signature) -> Result<(), Error> {
    let trains = find_all(
        arguments.trains.iter().flat_map(|list| ttb_trains::split(list)).collect::<Vec<_>>().iter().map(String::as_str),
    );
    let trains = trains.map_err(Error::Scenario)?;
    if let Some(percent) = arguments.damping.filter(|percent| !(0.0..=100.0).contains(percent)) {
        return Err(Error::Input(format!("--damping must be between 0 and 100 %: {percent}")));
    }
    let bridge = match &arguments.bridge {
        Some(path) => Some(known(&fmus::scenario(Some(path), &arguments.set)?)?),
        None => None,
    };
    let damping = bridge.as_ref().map_or(arguments.damping.map_or(DAMPING, |percent| 0.01 * percent), |b| b.damping);
    if let Some(Known { frequency, damping, .. }) = &bridge {
        say!("bridge: first frequency {frequency:.4} Hz, damping ratio {:.3} %", 100.0 * damping);
    }
    let hslm = find("hslm-a").map_err(Error::Scenario)?;
    let lengths = wavelengths();
    for train in &trains {
        show(train, damping, bridge.as_ref());
        if !train.name.starts_with("hslm-a") {
            let above = uncovered(train, &hslm, damping, &lengths);
            match above.iter().max_by(|a, b| (a[1] / a[2]).total_cmp(&(b[1] / b[2]))) {
                None => say!("  below the envelope of HSLM-A from {SHORTEST} to {LONGEST} m"),
                Some([length, own, envelope]) => {
                    let [own, envelope] = [own, envelope].map(|g| 1e-3 * g);
                    let share = above.len() as f64 / lengths.len() as f64;
                    say!(
                        "  above the envelope of HSLM-A at {:.0} % of the wavelengths from {SHORTEST} to {LONGEST} m, most at \
                         λ = {length:.2} m: {own:.0} against {envelope:.0} kN",
                        100.0 * share
                    );
                }
            }
        }
    }
    if let Some(path) = &arguments.output {
        let mut table = String::from("train,wavelength_m,amplitude_kn\n");
        for train in &trains {
            let signature = Of::new(train, damping);
            for length in &lengths {
                let _ = writeln!(table, "{},{length},{:.4}", train.name, 1e-3 * signature.amplitude(*length));
            }
        }
        files::write(path, table.as_bytes())?;
    }
    Ok(())
}

/// Wavelengths of a table, m: 2 cm apart.
fn wavelengths() -> Vec<f64> {
    let count = ((LONGEST - SHORTEST) * 50.0).round() as u32;
    (0..=count).map(|i| f64::from(225 + i) / 50.0).collect()
}

fn show(train: &ForceTrain, damping: f64, bridge: Option<&Known>) {
    let (axles, sum, length) = (train.axles.len(), 1e-3 * train.total(), train.length());
    say!("{}: {axles} axles, {sum:.0} kN, {length:.3} m", train.name);
    let signature = Of::new(train, damping);
    let resonances = signature.resonances([SHORTEST, LONGEST]);
    for resonance in resonances.iter().take(SHOWN) {
        let mut line = format!("  λ = {:6.2} m   G = {:7.1} kN", resonance.length, 1e-3 * resonance.amplitude);
        if let Some(Known { frequency, damping, simple }) = bridge {
            let speed = frequency * resonance.length;
            let _ = write!(line, "   v = {:6.1} km/h", 3.6 * speed);
            if let Some([length, mass]) = simple {
                let estimate = Of::new(train, *damping).lir(*length, *mass, *frequency, speed);
                let _ = write!(line, "   about {estimate:.2} m/s² after the train (LIR)");
            }
            if train.max_speed.is_some_and(|top| speed > 1.2 * top) {
                line.push_str("   faster than 1.2 times its top speed");
            }
        }
        say!("{line}");
    }
}

fn known(checked: &Checked) -> Result<Known, Error> {
    let spec = &checked.bridge;
    let bridge = ModalBridge::new(spec, &Settings::default()).map_err(|refused| Error::Input(refused.to_string()))?;
    bridge.remarks().iter().for_each(|remark| note!("ttb: warning: {remark}"));
    let first = bridge.modes().first().ok_or_else(|| Error::Input("bridge: no force on its deck moves it".into()))?;
    let simple = match &spec.structure {
        StructureSpec::Beams { spans, .. } if spans.len() == 1 => Some([spans[0].length, spans[0].mass]),
        _ => None,
    };
    Ok(Known { frequency: first.omega / std::f64::consts::TAU, damping: first.rate / (2.0 * first.omega), simple })
}
