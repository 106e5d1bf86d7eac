//! Track irregularity r(x), m, positive down, at any abscissa.
//!
//! A random sample of a one-sided spectral density S(Ω) is
//!
//! ```text
//! r(x) = Σ_k √(2 S(Ω_k) ΔΩ) cos(Ω_k x + φ_k),   Ω_k = k ΔΩ,   ΔΩ = 2π/P
//! ```
//!
//! over the wavelengths asked for, with phases φ_k drawn from ChaCha8 in the order of k. P is a power of two of metres, at
//! least 4,096 and at least twice the wheels' way, and x counts from 0 of the track. So one seed gives one rail: the same for
//! every train, speed, approach and wavelength band (a wider band adds waves and leaves the others), as long as the way is
//! below 2,048 m; a longer way takes the next P and with it another rail. Nothing but sines and sums enters, in a fixed order
//! and without vector instructions chosen at run time: the sample is the same on every machine to the rounding of its sine.
//!
//! The sum is transformed once into a table of r and r′ over P with at least 32 points per shortest wave. Between its points
//! the cubic through both is off by at most (2π/32)⁴/384 = 4e-6 of the amplitude of the shortest wave, and by the fourth
//! power of the ratio less for longer ones.

use std::f64::consts::{PI, TAU};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use realfft::RealFftPlanner;
use realfft::num_complex::Complex;
use ttb_scenario::spec::{Density, Profile};
use ttb_scenario::types::{Ramp, RampShape, Wave};

/// A random rail repeats itself after this length, m, or twice the wheels' way, rounded up to a power of two.
const LEAST_PERIOD: f64 = 4096.0;
/// Points of the table per shortest wave.
const POINTS_PER_WAVE: f64 = 32.0;
/// Over which a random irregularity fades in if the scenario does not say, m.
const DEFAULT_RAMP: f64 = 20.0;

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
    /// `way` is the abscissae between which wheels ever are, pre-roll included, m; `seed` replaces the seed of a random
    /// profile.
    #[must_use]
    pub fn new(profile: &Profile, scale: f64, way: [f64; 2], seed: Option<u64>) -> Self {
        let (form, ramp) = match profile {
            Profile::None => (Form::None, None),
            Profile::Waves { waves, origin, ramp } => {
                (Form::Waves { waves: waves.clone(), origin: *origin }, ramp.clone())
            }
            Profile::Spectrum { density, seed: own, wavelengths, ramp } => {
                let period = LEAST_PERIOD.max(2.0 * (way[1] - way[0])).log2().ceil().exp2();
                let table = Table::draw(density, *wavelengths, period, seed.unwrap_or(*own));
                let default = Ramp { start: way[0], length: DEFAULT_RAMP, shape: RampShape::Quintic };
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
    wave.amplitude * (TAU * x / wave.wavelength + wave.phase).sin()
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
        RampShape::Cosine => 0.5 * (1.0 - (PI * s).cos()),
    }
}

/// r and r′ at equal distances over one period.
#[derive(Clone, Debug)]
struct Table {
    period: f64,
    step: f64,
    /// (r in m, r′), the first at x = 0.
    points: Vec<[f64; 2]>,
}

impl Table {
    /// A sample of `density` with wavelengths from `shortest` to `longest`.
    fn draw(density: &Density, [shortest, longest]: [f64; 2], period: f64, seed: u64) -> Self {
        let count = (POINTS_PER_WAVE * period / shortest).log2().ceil().exp2() as usize;
        let spacing = TAU / period; // ΔΩ
        let band = (period / longest, period / shortest); // in units of ΔΩ
        let (first, last) = (band.0.round() as usize, band.1.round() as usize);

        let mut values = vec![Complex::default(); count / 2 + 1];
        let mut slopes = values.clone();
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        let mut random = ChaCha8Rng::from_seed(key);
        for k in 1..=last {
            let phase = TAU * (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
            if k < first {
                continue; // its phase is drawn all the same: the others must not depend on the band
            }
            let omega = k as f64 * spacing;
            // at the ends of the band a wave carries that part of its ΔΩ which lies within
            let width = spacing * ((k as f64 + 0.5).min(band.1) - (k as f64 - 0.5).max(band.0));
            let amplitude = (2.0 * density.value(omega) * width).sqrt();
            // a cos(Ωx + φ) = c e^{iΩx} + its conjugate, which the real transform supplies
            let c = Complex::from_polar(0.5 * amplitude, phase);
            values[k] = c;
            slopes[k] = Complex::i() * omega * c;
        }
        let points = inverse(values, count).into_iter().zip(inverse(slopes, count));
        Self { period, step: period / count as f64, points: points.map(|(r, slope)| [r, slope]).collect() }
    }

    /// The cubic with the values and slopes of the two neighbouring points.
    fn at(&self, x: f64) -> f64 {
        let position = x.rem_euclid(self.period) / self.step;
        let i = position as usize % self.points.len();
        let j = (i + 1) % self.points.len();
        hermite(position.fract(), self.step, self.points[i], self.points[j])
    }
}

/// Σ_k c_k e^{2πi k n/N} + conjugate for n = 0 … N − 1.
fn inverse(mut spectrum: Vec<Complex<f64>>, count: usize) -> Vec<f64> {
    let transform = RealFftPlanner::new().plan_fft_inverse(count);
    let mut values = transform.make_output_vec();
    let done = transform.process(&mut spectrum, &mut values);
    done.expect("the lengths are the plan's own, and c_0 and c_{N/2} are 0, so real");
    values
}

/// The cubic over a step with (value, slope) a at its begin and b at its end, at s = 0…1.
fn hermite(s: f64, step: f64, a: [f64; 2], b: [f64; 2]) -> f64 {
    let t = 1.0 - s;
    t * t * ((1.0 + 2.0 * s) * a[0] + s * step * a[1]) + s * s * ((1.0 + 2.0 * t) * b[0] - t * step * b[1])
}

/// Measured values, joined by cubics with continuous slope, constant outside.
#[derive(Clone, Debug)]
struct Samples {
    x: Vec<f64>,
    /// (r in m, r′).
    points: Vec<[f64; 2]>,
}

impl Samples {
    /// The slope at a sample is that of the parabola through it and its neighbours (Catmull and Rom's, for any spacing), at
    /// the ends 0, so that the constant outside goes on without a kink.
    fn new(x: &[f64], r: &[f64]) -> Self {
        let chord = |i: usize| (r[i + 1] - r[i]) / (x[i + 1] - x[i]);
        let slope = |i: usize| {
            if i == 0 || i + 1 == x.len() {
                return 0.0;
            }
            let (before, after) = (x[i] - x[i - 1], x[i + 1] - x[i]);
            (after * chord(i - 1) + before * chord(i)) / (before + after)
        };
        Self { x: x.to_vec(), points: (0..x.len()).map(|i| [r[i], slope(i)]).collect() }
    }

    fn at(&self, x: f64) -> f64 {
        let after = self.x.partition_point(|sample| *sample <= x);
        match (after.checked_sub(1), self.points.get(after)) {
            (Some(i), Some(next)) => {
                let step = self.x[after] - self.x[i];
                hermite((x - self.x[i]) / step, step, self.points[i], *next)
            }
            (Some(i), None) => self.points[i][0],
            (None, next) => next.map_or(0.0, |point| point[0]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAY: [f64; 2] = [0.0, 500.0];

    fn random(spectrum: &str, wavelengths: [f64; 2], seed: u64, ramp: Option<Ramp>) -> Profile {
        let density = ttb_scenario::bundled::spectrum(spectrum).unwrap();
        Profile::Spectrum { density, seed, wavelengths, ramp }
    }

    /// At full size everywhere.
    fn nowhere() -> Option<Ramp> {
        Some(Ramp { start: -1e9, length: 0.0, shape: RampShape::Quintic })
    }

    fn rail(spectrum: &str, wavelengths: [f64; 2], seed: u64) -> Irregularity {
        Irregularity::new(&random(spectrum, wavelengths, seed, nowhere()), 1.0, WAY, None)
    }

    /// docs/theory.md 15, mm. Over a whole period the waves are orthogonal, so that a sample has its σ up to the grid of
    /// Ω; over the wheels' way it scatters, as it should.
    #[test]
    fn samples_have_the_known_standard_deviations() {
        let known = [
            ("german-low", [3.0, 25.0], 0.9843),
            ("german-high", [3.0, 25.0], 1.6109),
            ("german-low", [1.0, 80.0], 2.0740),
            ("german-high", [1.0, 80.0], 3.3943),
            ("sncf-good", [2.0, 40.0], 1.2837),
            ("sncf-poor", [2.0, 40.0], 2.4073),
            ("china-ballastless", [2.0, 120.0], 0.7150),
        ];
        for (name, wavelengths, expected) in known {
            for seed in [1, 2] {
                let rail = rail(name, wavelengths, seed);
                let values: Vec<f64> = (0..200_000).map(|i| 1e3 * rail.at(LEAST_PERIOD / 2e5 * i as f64)).collect();
                let mean = values.iter().sum::<f64>() / values.len() as f64;
                let sigma = (values.iter().map(|r| r * r).sum::<f64>() / values.len() as f64).sqrt();
                assert!(mean.abs() < 1e-9, "{name}: mean {mean} mm");
                assert!(
                    (sigma / expected - 1.0).abs() < 1e-3,
                    "{name} {wavelengths:?}: {sigma} mm, known {expected} mm"
                );
            }
        }
    }

    #[test]
    fn the_table_is_as_close_to_the_sum_of_waves_as_it_says() {
        let (wavelengths, seed) = ([3.0, 25.0], 7);
        let density = ttb_scenario::bundled::spectrum("german-low").unwrap();
        let mut key = [0; 32];
        key[0] = seed as u8;
        let mut generator = ChaCha8Rng::from_seed(key);
        let spacing = TAU / LEAST_PERIOD;
        let phases: Vec<f64> = (0..1365).map(|_| TAU * (generator.next_u64() >> 11) as f64 / 2f64.powi(53)).collect();
        let sum = |x: f64| -> f64 {
            let waves = (164..=1365).map(|k| {
                let omega = k as f64 * spacing;
                let width =
                    spacing * ((k as f64 + 0.5).min(LEAST_PERIOD / 3.0) - (k as f64 - 0.5).max(LEAST_PERIOD / 25.0));
                (2.0 * density.value(omega) * width).sqrt() * (omega * x + phases[k - 1]).cos()
            });
            waves.sum()
        };
        let rail = rail("german-low", wavelengths, seed);
        let error = (0..500).map(|i| 0.7123 * i as f64 - 50.0).map(|x| (rail.at(x) - sum(x)).abs()).fold(0.0, f64::max);
        assert!(error < 5e-10, "{error} m, of a rail with σ = 1e-3 m");
    }

    #[test]
    fn the_same_seed_gives_the_same_rail_for_every_way_and_band() {
        let profile = random("sncf-good", [2.0, 40.0], 3, nowhere());
        let short = Irregularity::new(&profile, 1.0, [0.0, 200.0], None);
        let long = Irregularity::new(&profile, 1.0, [-700.0, 1300.0], None);
        let other = Irregularity::new(&profile, 1.0, [0.0, 200.0], Some(4));
        let named = Irregularity::new(&random("sncf-good", [2.0, 40.0], 4, nowhere()), 1.0, [0.0, 200.0], None);
        for x in [-3.0, 0.0, 17.23, 100.0] {
            assert_eq!(short.at(x), long.at(x));
            assert_eq!(other.at(x), named.at(x));
            assert_ne!(short.at(x), other.at(x));
        }
        // two bands side by side make up the whole: no phase depends on the band
        let band = |wavelengths| Irregularity::new(&random("sncf-good", wavelengths, 3, nowhere()), 1.0, WAY, None);
        let between = LEAST_PERIOD / 409.5; // two waves
        let (all, upper, lower) = (band([2.0, 40.0]), band([2.0, between]), band([between, 40.0]));
        for x in [1.0, 77.7, 300.3] {
            assert!((all.at(x) - upper.at(x) - lower.at(x)).abs() < 1e-8);
        }
    }

    /// From a separate program with its own ChaCha8 that sums the waves one by one, at points of the table. These values
    /// must never change, or stored results could not be repeated.
    #[test]
    fn a_seed_gives_the_rail_it_always_gave() {
        let rail = rail("german-low", [3.0, 80.0], 1);
        let known = [
            (0.0, 4.641854569426232e-3),
            (123.4375, 3.0352596692820605e-3),
            (-10.0, 2.460476972097553e-3),
            (2000.5, 2.0027121473694606e-3),
        ];
        for (x, expected) in known {
            assert!((rail.at(x) - expected).abs() < 1e-14, "r({x}) = {:e}, always {expected:e}", rail.at(x));
        }
    }

    #[test]
    fn a_random_irregularity_fades_in_over_20_m_from_where_the_way_begins() {
        let rail = Irregularity::new(&random("german-low", [3.0, 80.0], 1, None), 2.0, [100.0, 400.0], None);
        let full = self::rail("german-low", [3.0, 80.0], 1);
        assert_eq!(rail.at(99.9), 0.0);
        assert_eq!(rail.at(100.0), 0.0);
        assert!((rail.at(110.0) - full.at(110.0)).abs() < 1e-15); // half of twice
        assert!((rail.at(120.0) - 2.0 * full.at(120.0)).abs() < 1e-15);
    }

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
        let rail = Irregularity::new(&Profile::Waves { waves, origin: 30.0, ramp }, 1.0, WAY, None);
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

    #[test]
    fn samples_are_met_joined_smoothly_and_held_outside() {
        let (x, r) = (vec![0.0, 1.0, 1.5, 4.0, 5.0], vec![1e-3, 2e-3, 1.5e-3, -1e-3, 0.5e-3]);
        let rail = Irregularity::new(&Profile::Samples { x: x.clone(), r: r.clone(), ramp: None }, 1.0, WAY, None);
        for (x, r) in x.iter().zip(&r) {
            assert!((rail.at(*x) - r).abs() < 1e-18);
            let h = 1e-6;
            let (left, right) = ((rail.at(*x) - rail.at(x - h)) / h, (rail.at(x + h) - rail.at(*x)) / h);
            assert!((left - right).abs() < 1e-7, "slope at {x}: {left} and {right}");
        }
        assert_eq!((rail.at(-9.0), rail.at(99.0)), (1e-3, 0.5e-3));
        // a parabola is met inside, whatever the spacing
        let x: Vec<f64> = [0.0, 0.7, 1.0, 2.0, 2.2, 3.0].to_vec();
        let r: Vec<f64> = x.iter().map(|x| 1e-3 * x * x).collect();
        let rail = Irregularity::new(&Profile::Samples { x, r, ramp: None }, 1.0, WAY, None);
        assert!((rail.at(1.6) - 2.56e-3).abs() < 1e-15);
    }

    #[test]
    fn a_table_goes_on_over_its_seam() {
        let rail = rail("german-low", [3.0, 80.0], 5);
        let h = 1e-7;
        for x in [0.0, LEAST_PERIOD, -LEAST_PERIOD] {
            assert!((rail.at(x + h) - rail.at(x - h)).abs() < 1e-8);
            assert!((rail.at(x) - rail.at(0.0)).abs() < 1e-15);
        }
    }
}
