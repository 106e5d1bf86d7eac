//! Track irregularity r(x), m, positive down, at any abscissa: waves, a random sample ([`random`]) or measured values
//! (`samples`), grown from nothing where it begins.

mod fourier;
mod hermite;
pub mod rails;
pub mod random;
mod samples;

use std::f64::consts::{PI, TAU};

use ttb_scenario::spec::Profile;
use ttb_scenario::travel::DEFAULT_RAMP;
use ttb_scenario::types::{Ramp, RampShape, Wave};

use random::Table;
use samples::Samples;

/// An irregularity, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Irregularity {
    form: Form,
    ramp: Option<Ramp>,
    scale: f64,
}

#[derive(Clone, Debug)]
enum Form {
    None,
    Waves { waves: Vec<Wave>, origin: f64 },
    Random(Table),
    Samples(Samples),
}

impl Irregularity {
    /// Prepares `profile`, all its values multiplied by `scale`.
    ///
    /// `passage` is the abscissae between which wheels ever are, pre-roll included, m; `seed` replaces the seed of a random
    /// profile.
    #[must_use]
    pub fn new(profile: &Profile, scale: f64, passage: [f64; 2], seed: Option<u64>) -> Self {
        Self::component(profile, scale, passage, seed, 0)
    }

    /// The same of a component of several, whose random phases are `stream`s of one seed: 0 is the level.
    #[must_use]
    pub fn component(profile: &Profile, scale: f64, passage: [f64; 2], seed: Option<u64>, stream: u8) -> Self {
        let (form, ramp) = match profile {
            Profile::None => (Form::None, None),
            Profile::Waves { waves, origin, ramp } => {
                (Form::Waves { waves: waves.clone(), origin: *origin }, ramp.clone())
            }
            Profile::Spectrum { density, seed: own, wavelengths, ramp } => {
                let table = Table::draw(density, *wavelengths, passage[1] - passage[0], seed.unwrap_or(*own), stream);
                let default = Ramp { start: passage[0], length: DEFAULT_RAMP, shape: RampShape::Quintic };
                (Form::Random(table), Some(ramp.clone().unwrap_or(default)))
            }
            Profile::Samples { x, r, ramp } => (Form::Samples(Samples::new(x, r)), ramp.clone()),
        };
        Self { form, ramp, scale }
    }

    /// r(x), m, positive down.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        let r = match &self.form {
            Form::None => return 0.0,
            Form::Waves { waves, origin } => waves.iter().map(|wave| sine(wave, x - origin)).sum(),
            Form::Random(table) => table.at(x),
            Form::Samples(samples) => samples.at(x),
        };
        self.scale * self.ramp.as_ref().map_or(1.0, |ramp| grown(ramp, x)) * r
    }
}

/// One wave at the distance `x` from its origin.
fn sine(wave: &Wave, x: f64) -> f64 {
    wave.amplitude * libm::sin(TAU * x / wave.wavelength + wave.phase)
}

/// How far a ramp has grown at x: 0 before it, 1 behind it.
fn grown(ramp: &Ramp, x: f64) -> f64 {
    let past = x - ramp.start;
    if past < 0.0 {
        return 0.0;
    }
    if past >= ramp.length {
        return 1.0;
    }
    let s = past / ramp.length;
    match ramp.shape {
        RampShape::Quintic => s * s * s * (10.0 - 15.0 * s + 6.0 * s * s),
        RampShape::Cosine => 0.5 * (1.0 - libm::cos(PI * s)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ramps_begin_and_end_without_a_kink() {
        for shape in [RampShape::Quintic, RampShape::Cosine] {
            let ramp = Ramp { start: 5.0, length: 10.0, shape };
            assert_eq!((grown(&ramp, 4.0), grown(&ramp, 5.0), grown(&ramp, 15.0)), (0.0, 0.0, 1.0));
            assert!((grown(&ramp, 10.0) - 0.5).abs() < 1e-15);
            let h = 1e-4;
            for x in [5.0, 15.0] {
                let slope = (grown(&ramp, x + h) - grown(&ramp, x - h)) / (2.0 * h);
                assert!(slope.abs() < 1e-5, "{shape:?} at {x}: {slope}");
            }
        }
        let step = Ramp { start: 5.0, length: 0.0, shape: RampShape::Quintic };
        assert_eq!((grown(&step, 4.999), grown(&step, 5.0)), (0.0, 1.0));
    }

    /// The irregularity of case R1, written out.
    #[test]
    fn waves_are_evaluated_as_they_are_written() {
        let wave = |amplitude, wavelength| Wave { amplitude, wavelength, phase: 0.0 };
        let waves = vec![wave(2e-3, 25.0), wave(0.5e-3, 8.0), wave(0.1e-3, 2.0)];
        let ramp = Some(Ramp { start: 30.0, length: 10.0, shape: RampShape::Cosine });
        let rail = Irregularity::new(&Profile::Waves { waves, origin: 30.0, ramp }, 1.0, [0.0, 500.0], None);
        for x in [29.0, 30.0, 33.3, 39.9, 40.0, 71.7] {
            let far: f64 = x - 30.0;
            let ramp = if far < 0.0 {
                0.0
            } else if far < 10.0 {
                0.5 * (1.0 - (PI * far / 10.0).cos())
            } else {
                1.0
            };
            let waves = 2e-3 * (TAU * far / 25.0).sin() + 0.5e-3 * (TAU * far / 8.0).sin() + 0.1e-3 * (PI * far).sin();
            assert!((rail.at(x) - ramp * waves).abs() < 1e-17);
        }
    }
}
