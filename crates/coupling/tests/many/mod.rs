//! Two subsystems that answer at once, N forces, 2 N motions:
//!
//! ```text
//! bridge        d = H λ,  ḋ = 0,    H_ij = ρ/S · 2^−|i−j|,    S so that the largest eigenvalue of H is about ρ
//! train–track   G_i = load_i(t) − d_i − c d_i²/200
//! ```

use ttb_contract::{Failure, Ports, Subsystem};
use ttb_coupling::{Method, OnFailure, Predictor, Settings};

/// Forces.
pub const N: usize = 40;

/// Either side.
pub struct Side {
    rho: f64,
    curvature: f64,
    is_bridge: bool,
    /// No load, as before a train comes.
    pub at_rest: bool,
    /// Offers directional derivatives, too large by the factor `excess`.
    pub derives: bool,
    /// See `derives`.
    pub excess: f64,
    /// Understands rates of its inputs.
    pub interpolates: bool,
    /// Refuses to step with an input above this.
    pub strongest: f64,
    /// Output number 3 is infinite from this time on.
    pub infinite_from: f64,
    input: Vec<f64>,
    rate: Vec<f64>,
    output: Vec<f64>,
    saved: Vec<f64>,
    time: f64,
}

/// A pair with contraction `rho`; `curvature` bends the track.
pub fn pair(rho: f64, curvature: f64) -> (Side, Side) {
    let side = |is_bridge: bool| {
        let (inputs, outputs) = if is_bridge { (N, 2 * N) } else { (2 * N, N) };
        let (input, rate, output, saved) =
            (vec![0.0; inputs], vec![0.0; inputs], vec![0.0; outputs], vec![0.0; outputs]);
        let (at_rest, derives, excess, strongest, time) = (false, false, 1.0, f64::INFINITY, 0.0);
        let infinite_from = f64::INFINITY;
        Side {
            rho,
            curvature,
            is_bridge,
            at_rest,
            derives,
            excess,
            interpolates: true,
            strongest,
            infinite_from,
            input,
            rate,
            output,
            saved,
            time,
        }
    };
    (side(false), side(true))
}

/// N vertical ports; a force of 100 N counts.
pub fn ports() -> Ports {
    Ports::vertical(N, 100.0)
}

/// Settings for a method.
pub fn settings(method: Method) -> Settings {
    Settings {
        method,
        reuse: 3,
        predictor: Predictor::Linear,
        tolerance: 1e-9,
        max_iterations: 30,
        hold_forces: false,
        mean_forces: false,
        on_failure: OnFailure::Stop,
    }
}

impl Side {
    fn answer(&self, input: &[f64], output: &mut [f64]) {
        if self.is_bridge {
            // 1 + 2 (1/2 + 1/4 + …) = 3, nearly, for the eigenvector that varies least.
            for (i, out) in output[..N].iter_mut().enumerate() {
                let weight = |j: usize| 0.5_f64.powi(i.abs_diff(j) as i32);
                *out = self.rho / 3.0 * (0..N).map(|j| weight(j) * input[j]).sum::<f64>();
            }
            output[N..].fill(0.0);
            if self.time >= self.infinite_from {
                output[3] = f64::INFINITY;
            }
        } else {
            let t = self.time;
            for (i, out) in output.iter_mut().enumerate() {
                let load = (-(i as f64 - 60.0 * t).powi(2) / 20.0).exp() * 100.0 * (1.0 + 0.1 * (40.0 * t).sin());
                let load = if self.at_rest { 0.0 } else { load };
                *out = load - input[i] - self.curvature * input[i] * input[i] / 200.0;
            }
        }
    }
    /// Largest |G(λ) − λ| at time t.
    pub fn defect(&self, bridge: &Side, forces: &[f64], t: f64) -> f64 {
        let (mut d, mut g) = (vec![0.0; 2 * N], vec![0.0; N]);
        bridge.answer(forces, &mut d);
        assert!((self.time - t).abs() < 1e-12);
        self.answer(&d, &mut g);
        g.iter().zip(forces).map(|(g, l)| (g - l).abs()).fold(0.0, f64::max)
    }
    fn refresh(&mut self, h: f64) {
        let input: Vec<f64> = self.input.iter().zip(&self.rate).map(|(v, r)| v + h * r).collect();
        let mut output = std::mem::take(&mut self.output);
        self.answer(&input, &mut output);
        self.output = output;
    }
}

impl Subsystem for Side {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        self.input.copy_from_slice(values);
        match rates {
            Some(rates) => self.rate.copy_from_slice(rates),
            None => self.rate.fill(0.0),
        }
        if self.time == 0.0 {
            self.refresh(0.0);
        }
        Ok(())
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        outputs.copy_from_slice(&self.output);
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn step(&mut self, t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        if self.input.iter().zip(&self.rate).any(|(v, r)| v + h * r > self.strongest) {
            return Err(Failure::new("side", "it is too much"));
        }
        self.time = t + h;
        self.refresh(h);
        Ok(())
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.saved.copy_from_slice(&self.output);
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Failure> {
        self.output.copy_from_slice(&self.saved);
        Ok(())
    }
    fn name(&self) -> &str {
        "side"
    }
    fn can_interpolate(&self) -> bool {
        self.interpolates
    }
    fn can_derive(&self) -> bool {
        self.derives
    }
    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        self.answer(seed, change);
        change.iter_mut().for_each(|c| *c *= self.excess);
        Ok(())
    }
}
