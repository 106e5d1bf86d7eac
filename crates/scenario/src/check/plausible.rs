//! Which numbers of a scenario are compared with their usual ranges ([`crate::ranges`]), and what follows from several.
//!
//! ```text
//! bounce of a body     √(2 k_s/M_c) / 2π          of a bogie between its springs   √((2 k_p + k_s)/M_b) / 2π
//! damping ratio        c_s / 2√(k_s M_c/2)        radius of gyration               √(J/M)
//! rail under an axle   w = P b/2k,  b = (k/4EI)^{1/4},  k: springs of a support in series, over their spacing
//! ```

use std::f64::consts::TAU;

use super::frequency;
use crate::pieces::Pieces;
use crate::problem::{Report, Warning};
use crate::ranges::judge;
use crate::resolve::Resolved;
use crate::spec::{Profile, StructureSpec, Vehicle};
use crate::types::{
    Car, CarChoice, Contact, Damping, FrameChoice, Irregularity, ModelChoice, Spring, Structure, Support, TrackChoice,
    TrackType,
};

/// Compares everything that can be read.
pub(super) fn check(pieces: &Pieces, resolved: &Resolved, report: &mut Report) {
    let mut all = Judge { report };
    for (i, choice) in pieces.cars.iter().enumerate() {
        if let Some(CarChoice::Data(car)) = choice {
            all.car(car, &format!("$.train.cars[{i}]"));
        }
    }
    if let Some(contact) = &pieces.contact {
        all.contact(contact);
    }
    if let Some(TrackChoice::Data(track)) = &pieces.track_type {
        all.track(track);
    }
    if let (Some(track), Some(cars)) = (&resolved.track, &resolved.cars) {
        let load = cars.iter().flat_map(Vehicle::axles).map(|[load, _]| load).fold(0.0, f64::max);
        all.positive("track.deflection", "$.track.type", deflection(track, load));
    }
    let speed = resolved.speed.iter().flatten().map(|[_, v]| *v).fold(0.0, f64::max);
    all.positive("train.speed", "$.train.speed", speed);
    if let (Some(chosen), Some(profile)) = (&pieces.irregularity, &resolved.profile) {
        all.irregularity(chosen, profile);
    }
    for (path, x) in [
        ("$.train.front_wheel", pieces.train.as_ref().and_then(|train| train.front_wheel)),
        ("$.track.from", pieces.track.as_ref().and_then(|track| track.from)),
        ("$.bridge.at", pieces.at),
    ] {
        x.map(|x| all.any("place", path, x));
    }
    if let Some(structure) = &pieces.structure {
        all.structure(structure);
    }
    if let Some(Damping::Rayleigh { ratio, .. } | Damping::Modal { ratio, .. }) = &pieces.damping {
        all.positive("damping.ratio", "$.bridge.damping.ratio", *ratio);
    }
    if let Some(Structure::Matrices { files, .. }) = &pieces.structure
        && files.points.is_none()
    {
        let path = "$.bridge.structure.files.points";
        let text = format!(
            "{path}: there is no file of points: results will have no displacement and acceleration of the deck"
        );
        report.note(Warning::at(path, text));
    }
    let own = !matches!(resolved.structure, None | Some(StructureSpec::Matrices { .. } | StructureSpec::Stored));
    if own && pieces.has_points && pieces.points.is_empty() {
        let text = "$.bridge.points: there is no monitored point: results will have no displacement and acceleration of \
                    the deck; for mid-span give { \"name\": \"mid\", \"x\": … }";
        report.note(Warning::at("$.bridge.points", text));
    }
}

/// Static deflection, m; of numbers that make no sense NaN or infinite.
fn deflection(track: &TrackType, load: f64) -> f64 {
    let springs: &[&Spring] = match &track.support {
        Support::SingleLayer { fastener } => &[fastener],
        Support::TwoLayer { pad, ballast, .. } => &[pad, ballast],
        Support::ThreeLayer { pad, ballast, sub_ballast, .. } => &[pad, ballast, sub_ballast],
    };
    let k = 1.0 / (track.spacing * springs.iter().map(|spring| 1.0 / spring.stiffness).sum::<f64>());
    let b = (k / (4.0 * track.rail.bending_stiffness)).powf(0.25);
    load * b / (2.0 * k)
}

struct Judge<'a> {
    report: &'a mut Report,
}

impl Judge<'_> {
    fn any(&mut self, what: &str, path: &str, value: f64) -> bool {
        judge(what, path, value, self.report)
    }

    /// What is 0 or less is meant so, or the schema has complained.
    fn positive(&mut self, what: &str, path: &str, value: f64) -> bool {
        value <= 0.0 || value.is_nan() || self.any(what, path, value)
    }

    fn car(&mut self, car: &Car, path: &str) {
        let frequency = |k: f64, m: f64| (k / m).sqrt() / TAU;
        let Car { body_mass: m, secondary_stiffness: k, .. } = *car;
        let mut usual = self.positive("car.axle_load", path, car.axle_load());
        for (what, key, value) in [
            ("car.length", "length", car.length),
            ("car.bogie_distance", "bogie_distance", car.bogie_distance),
            ("car.wheelbase", "wheelbase", car.wheelbase),
            ("car.body_mass", "body_mass", m),
            ("car.bogie_mass", "bogie_mass", car.bogie_mass),
            ("car.wheelset_mass", "wheelset_mass", car.wheelset_mass),
        ] {
            usual &= self.positive(what, &format!("{path}.{key}"), value);
        }
        if !usual {
            return; // what follows from several numbers would only repeat it
        }
        for (what, key, value) in [
            ("car.bounce", "secondary_stiffness", frequency(2.0 * k, m)),
            ("car.bogie_bounce", "primary_stiffness", frequency(2.0 * car.primary_stiffness + k, car.bogie_mass)),
            ("car.secondary_damping_ratio", "secondary_damping", car.secondary_damping / (2.0 * k * m).sqrt()),
            ("car.body_gyration", "body_inertia", (car.body_inertia / m).sqrt() / car.length),
            ("car.bogie_gyration", "bogie_inertia", (car.bogie_inertia / car.bogie_mass).sqrt() / car.wheelbase),
        ] {
            self.positive(what, &format!("{path}.{key}"), value);
        }
    }

    fn contact(&mut self, contact: &Contact) {
        if let Some(g) = contact.hertz_constant {
            self.positive("contact.hertz_constant", "$.contact.hertz_constant", g);
        }
        self.positive("contact.wheel_radius", "$.contact.wheel_radius", contact.wheel_radius);
    }

    fn track(&mut self, track: &TrackType) {
        let base = "$.track.type";
        self.positive(
            "rail.bending_stiffness",
            &format!("{base}.rail.bending_stiffness"),
            track.rail.bending_stiffness,
        );
        self.positive("rail.mass", &format!("{base}.rail.mass"), track.rail.mass);
        self.positive("track.spacing", &format!("{base}.spacing"), track.spacing);
        let mut spring = |key: &str, spring: &Spring| {
            self.positive("track.spring", &format!("{base}.support.{key}.stiffness"), spring.stiffness);
            self.positive("track.damping", &format!("{base}.support.{key}.damping"), spring.damping);
        };
        let (sleeper, ballast) = match &track.support {
            Support::SingleLayer { fastener } => {
                spring("fastener", fastener);
                (0.0, 0.0)
            }
            Support::TwoLayer { pad, sleeper_mass, ballast } => {
                spring("pad", pad);
                spring("ballast", ballast);
                (*sleeper_mass, 0.0)
            }
            Support::ThreeLayer { pad, sleeper_mass, ballast, ballast_mass, sub_ballast, .. } => {
                spring("pad", pad);
                spring("ballast", ballast);
                spring("sub_ballast", sub_ballast);
                (*sleeper_mass, *ballast_mass)
            }
        };
        self.positive("track.sleeper_mass", &format!("{base}.support.sleeper_mass"), sleeper);
        self.positive("track.ballast_mass", &format!("{base}.support.ballast_mass"), ballast);
    }

    /// σ over what the scenario gives: all waves, the band of the spectrum, the samples about their mean.
    fn irregularity(&mut self, chosen: &Irregularity, profile: &Profile) {
        let (scale, place) = match chosen {
            Irregularity::None => return,
            Irregularity::Harmonics { scale, .. } => (*scale, "$.irregularity.waves"),
            Irregularity::Spectrum { scale, .. } => (*scale, "$.irregularity.scale"),
            Irregularity::Measured { scale, .. } => (*scale, "$.irregularity.file"),
        };
        let sigma = match profile {
            Profile::None => 0.0,
            Profile::Waves { waves, .. } => waves.iter().map(|wave| 0.5 * wave.amplitude.powi(2)).sum::<f64>().sqrt(),
            Profile::Spectrum { density, wavelengths: [short, long], .. } if 0.0 < *short && short < long => {
                density.sigma(*short, *long)
            }
            Profile::Spectrum { .. } => 0.0,
            Profile::Samples { x, r, .. } => {
                let spacing = x.first().zip(x.last()).map_or(0.0, |(a, b)| (b - a) / (x.len() - 1).max(1) as f64);
                self.positive("irregularity.spacing", place, spacing);
                let n = r.len().max(1) as f64;
                let mean = r.iter().sum::<f64>() / n;
                (r.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / n).sqrt()
            }
        };
        self.positive("irregularity.sigma", place, sigma * scale.abs());
    }

    fn structure(&mut self, structure: &Structure) {
        let base = "$.bridge.structure";
        match structure {
            Structure::Beams { spans, continuous, .. } => {
                for (i, span) in spans.iter().enumerate() {
                    let path = format!("{base}.spans[{i}]");
                    let usual = self.positive("span.length", &format!("{path}.length"), span.length)
                        & self.positive("span.mass", &format!("{path}.mass"), span.mass);
                    if let Some(elements) = span.elements {
                        self.positive("span.elements", &format!("{path}.elements"), elements as f64);
                    }
                    if usual && (!continuous || spans.len() == 1) {
                        frequency::check(span, &path, self.report);
                    }
                }
            }
            Structure::Frame { frame: FrameChoice::Data(frame) } => {
                for (i, section) in frame.sections.iter().enumerate() {
                    let path = format!("{base}.frame.sections[{i}]");
                    self.positive("section.modulus", &format!("{path}.modulus"), section.modulus);
                    self.positive("section.mass", &format!("{path}.mass"), section.mass);
                }
            }
            Structure::FiniteElements { model: ModelChoice::Data(model) } => {
                for (i, material) in model.materials.iter().enumerate() {
                    let path = format!("{base}.model.materials[{i}]");
                    self.positive("section.modulus", &format!("{path}.modulus"), material.modulus);
                    self.positive("material.density", &format!("{path}.density"), material.density);
                }
            }
            _ => {}
        }
    }
}
