//! What rolled-back trials tell of G before a step is taken: its contraction, its Jacobian.

use crate::dense::norm;
use crate::exchange::Sides;
use crate::iteration::Coupling;
use crate::newton::Model;
use crate::report::{IterationError, Source};

/// Trials of the power iteration beyond the first.
pub(crate) const POWER: usize = 3;
/// Change of a force to see its effect, axle loads: large beside the rounding of any FMU, small beside the contacts'
/// curvature.
pub(crate) const PROBE: f64 = 1e-3;
/// Derivatives off by more than this, relatively, are not those of the steps.
const CREDIBLE: f64 = 1e-3;

/// A load that is much alike everywhere, with something of every other shape: multiples of the golden section, modulo 1.
pub(crate) fn shape(i: usize) -> f64 {
    0.5 + (i as f64 * 0.618_033_988_749_895).fract()
}

impl Coupling {
    /// ρ, the largest eigenvalue of −∂G/∂λ for the step from the saved states, by power iteration with
    /// 1 + [`POWER`] trials from the forces predicted:
    ///
    /// ```text
    /// v ← G(λ⁰ + v) − G(λ⁰),    ρ ≈ |v_{k+1}|/|v_k|
    /// ```
    ///
    /// All eigenvalues are real and not negative, so the quotients grow towards ρ. A deck yields most to loads that
    /// are alike everywhere; that is where v begins.
    pub(crate) fn contraction(&mut self, sides: &mut Sides) -> Result<f64, IterationError> {
        let (n, scale) = (self.lambda.len(), PROBE * self.settings.force_scale);
        let (mut base, mut v) = (vec![0.0; n], vec![0.0; n]);
        let trial = self.lambda.clone();
        self.trial(sides)?;
        base.copy_from_slice(&self.answer);
        v.iter_mut().enumerate().for_each(|(i, v)| *v = shape(i));
        let mut rho = 0.0;
        for _ in 0..POWER {
            let size = norm(&v);
            if !(size > 0.0 && size.is_finite()) {
                break;
            }
            let factor = scale * (n as f64).sqrt() / size;
            self.lambda.iter_mut().zip(&trial).zip(&v).for_each(|((l, t), v)| *l = t + factor * v);
            self.trial(sides)?;
            v.iter_mut().zip(&self.answer).zip(&base).for_each(|((v, g), base)| *v = (g - base) / factor);
            rho = norm(&v) / size;
        }
        self.lambda = trial;
        self.report.identification_trials += POWER + 1;
        Ok(rho)
    }

    /// H = ∂(d, ḋ)/∂λ and J = I − ∂G/∂λ for the step from the saved states: by directional derivatives of the bridge
    /// where they stand a test, else by its steps; the train–track subsystem steps once for every force.
    pub(crate) fn identify(&mut self, sides: &mut Sides) -> Result<Model, IterationError> {
        let n = self.lambda.len();
        let trial = self.lambda.clone();
        self.trial(sides)?;
        let (base, motion) = (self.answer.clone(), self.exchange.motion.clone());
        let scale = PROBE * self.settings.force_scale;
        let derivatives = self.derivatives_hold(sides, &trial, &motion)?;
        let (mut jacobian, mut compliance) = (vec![0.0; n * n], vec![0.0; n * motion.len()]);
        let (mut seed, mut change) = (vec![0.0; n], vec![0.0; motion.len()]);
        let share = scale * self.exchange.share_of_force(sides.bridge);
        for j in 0..n {
            if derivatives {
                seed[j] = share;
                sides.bridge.derivative(&seed, &mut change)?;
                seed[j] = 0.0;
                sides.train_track.restore()?;
                self.exchange.motion.iter_mut().zip(&motion).zip(&change).for_each(|((m, at), d)| *m = at + d);
                self.exchange.train_track(sides, &mut self.answer, true)?;
            } else {
                self.lambda[j] = trial[j] + scale;
                self.trial(sides)?;
                self.lambda[j] = trial[j];
            }
            for i in 0..n {
                jacobian[i * n + j] = f64::from(u8::from(i == j)) - (self.answer[i] - base[i]) / scale;
            }
            for (i, at) in motion.iter().enumerate() {
                compliance[i * n + j] = (self.exchange.motion[i] - at) / scale;
            }
        }
        self.lambda = trial;
        self.report.identification_trials += n + 1;
        self.report.model = Some(if derivatives { Source::Derivatives } else { Source::Trials });
        Ok(Model { compliance, jacobian, n })
    }

    /// Whether the bridge's directional derivatives are those of its steps *as the forces are sent*: along one
    /// change of all forces they must give what a step gives. The bridge is left at the end of the step at λ⁰.
    fn derivatives_hold(&mut self, sides: &mut Sides, trial: &[f64], motion: &[f64]) -> Result<bool, IterationError> {
        if !sides.bridge.can_derive() {
            return Ok(false);
        }
        let scale = PROBE * self.settings.force_scale;
        let share = self.exchange.share_of_force(sides.bridge);
        let wave = |i: usize| scale * shape(i);
        let seed: Vec<f64> = (0..trial.len()).map(|i| share * wave(i)).collect();
        let mut change = vec![0.0; motion.len()];
        let derived = sides.bridge.derivative(&seed, &mut change);
        let probe: Vec<f64> = trial.iter().enumerate().map(|(i, t)| t + wave(i)).collect();
        sides.bridge.restore()?;
        self.exchange.bridge(sides, self.forces.now(), &probe, true)?;
        // Displacements and velocities have different units: each half is compared with itself.
        let half = motion.len() / 2;
        let near = |range: std::ops::Range<usize>| {
            let seen = |i: usize| self.exchange.motion[i] - motion[i];
            let off: f64 = range.clone().map(|i| (seen(i) - change[i]).powi(2)).sum();
            let whole: f64 = range.map(|i| seen(i).powi(2)).sum();
            off <= CREDIBLE * CREDIBLE * whole
        };
        let holds = derived.is_ok() && near(0..half) && near(half..motion.len());
        sides.bridge.restore()?;
        self.exchange.bridge(sides, self.forces.now(), trial, true)?;
        self.report.identification_trials += 1;
        Ok(holds)
    }
}
