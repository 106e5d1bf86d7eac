//! The dynamic signature of a train, and estimates from it.
//!
//! ```text
//! G(λ) = max_k |Σ_{j≤k} P_j e^{2πi x_j/λ} e^{−2πζ (x_k − x_j)/λ}|                  λ = v/f
//! a ≈ 2/(mL) A(K) G(λ),  K = λ/2L,  A = |K/(1 − K²)| √(1 + e^{−2ζπ/K} + 2 e^{−ζπ/K} cos(π/K))
//! ```
//!
//! The second line is the method of residual influence lines (LIR; ERRI D 214/RP 6): acceleration at mid-span of a simple
//! span after the train, first mode alone. Use: to order trains, to place refinements, to ask whether HSLM-A covers a
//! train; never for a verdict.

use std::f64::consts::{PI, TAU};

use crate::train::ForceTrain;

/// Shortest wavelength of a signature, m: EN 1991-2, annex E, counts from 4.5 m.
pub const SHORTEST: f64 = 4.5;
/// A resonance length's G is at least so much of the largest.
const NOTABLE: f64 = 0.5;

/// The signature of a train for one damping ratio.
#[derive(Clone, Debug)]
pub struct Signature<'a> {
    train: &'a ForceTrain,
    /// ζ, of 1.
    damping: f64,
}

/// A wavelength at which a signature has a maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resonance {
    /// Wavelength λ, m.
    pub length: f64,
    /// G there, N.
    pub amplitude: f64,
}

impl<'a> Signature<'a> {
    /// Of a train, for a damping ratio of the bridge.
    #[must_use]
    pub fn new(train: &'a ForceTrain, damping: f64) -> Self {
        Self { train, damping }
    }

    /// G at the wavelength λ in m, N.
    #[must_use]
    pub fn amplitude(&self, length: f64) -> f64 {
        let (mut re, mut im, mut largest, mut before) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0);
        for axle in &self.train.axles {
            let decay = libm::exp(-TAU * self.damping * (axle.x - before) / length);
            let (sin, cos) = libm::sincos(TAU * axle.x / length);
            (re, im) = (re * decay + axle.load * cos, im * decay + axle.load * sin);
            largest = largest.max(re * re + im * im);
            before = axle.x;
        }
        largest.sqrt()
    }

    /// Wavelengths between `range[0]` and `range[1]`, m, at which G has a maximum of at least half the largest, that of
    /// the largest G first.
    #[must_use]
    pub fn resonances(&self, range: [f64; 2]) -> Vec<Resonance> {
        // Near a maximum G falls over a change of λ of about λ²/length: in 1/λ all maxima are equally wide.
        let length = self.train.length().max(10.0);
        let [low, high] = [1.0 / range[1], 1.0 / range[0]];
        let count = (8.0 * length * (high - low)).ceil().max(16.0) as usize;
        let at = |i: usize| low + (high - low) * i as f64 / count as f64;
        let g: Vec<f64> = (0..=count).map(|i| self.amplitude(1.0 / at(i))).collect();
        let mut found: Vec<Resonance> = (1..count)
            .filter(|i| g[*i] > g[i - 1] && g[*i] >= g[i + 1])
            .map(|i| {
                let place = golden(|n| self.amplitude(1.0 / n), at(i - 1), at(i + 1));
                Resonance { length: 1.0 / place, amplitude: self.amplitude(1.0 / place) }
            })
            .collect();
        found.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
        let largest = g.iter().copied().fold(0.0, f64::max);
        found.retain(|resonance| resonance.amplitude >= NOTABLE * largest);
        found
    }

    /// LIR estimate of the acceleration, m/s², at mid-span of a simple span of `length` m and `mass` kg/m, whose first
    /// frequency is `frequency` Hz, at `speed` m/s.
    #[must_use]
    pub fn lir(&self, length: f64, mass: f64, frequency: f64, speed: f64) -> f64 {
        let wave = speed / frequency;
        2.0 / (mass * length) * influence(wave / (2.0 * length), self.damping) * self.amplitude(wave)
    }
}

/// A(K) of the module comment. Where the formula has its pole, |K − 1| < 0.02, the straight line between both sides.
fn influence(k: f64, damping: f64) -> f64 {
    const NEAR: f64 = 0.02;
    let formula = |k: f64| {
        let decay = libm::exp(-damping * PI / k);
        (k / (1.0 - k * k)).abs() * (1.0 + decay * decay + 2.0 * decay * libm::cos(PI / k)).max(0.0).sqrt()
    };
    if (k - 1.0).abs() >= NEAR {
        return formula(k);
    }
    let share = (k - 1.0 + NEAR) / (2.0 * NEAR);
    (1.0 - share) * formula(1.0 - NEAR) + share * formula(1.0 + NEAR)
}

/// The place of the maximum of a function with one maximum between `a` and `b`.
fn golden(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    const SHARE: f64 = 0.618_033_988_749_894_9;
    let [mut c, mut d] = [b - SHARE * (b - a), a + SHARE * (b - a)];
    let [mut fc, mut fd] = [f(c), f(d)];
    for _ in 0..40 {
        if fc > fd {
            (b, d, fd) = (d, c, fc);
            c = b - SHARE * (b - a);
            fc = f(c);
        } else {
            (a, c, fc) = (c, d, fd);
            d = a + SHARE * (b - a);
            fd = f(d);
        }
    }
    0.5 * (a + b)
}

/// Where the signature of a train is above the envelope of others, as (λ, G, envelope), m and N; empty: it is covered.
#[must_use]
pub fn uncovered(train: &ForceTrain, others: &[ForceTrain], damping: f64, lengths: &[f64]) -> Vec<[f64; 3]> {
    let own = Signature::new(train, damping);
    let others: Vec<Signature> = others.iter().map(|other| Signature::new(other, damping)).collect();
    let row = |length: &f64| {
        let envelope = others.iter().map(|other| other.amplitude(*length)).fold(0.0, f64::max);
        [*length, own.amplitude(*length), envelope]
    };
    lengths.iter().map(row).filter(|[_, own, envelope]| own > envelope).collect()
}
