//! Links that are not linear: stops, and dampers that blow off or stand in series with a spring.
//!
//! ```text
//! stop               f = −F(|d|) sign d                      F piecewise linear
//! damper             f = −D(ḋ),  D(w) = c w up to the blow-off force, then with the rate beyond it
//! with a spring k    f = −D(ẋ) = −k (d − x),  ẋ of the damper:  x₁ = x₀ + h((1 − γ)ẋ₀ + γẋ₁)
//! ```
//!
//! f acts on the first body. Of the damper in series the state is (x, ẋ).

/// Law of one link; d its stretch.
#[derive(Clone, Debug)]
pub enum Element {
    /// (|d|, F) of the bends.
    Stop(Vec<[f64; 2]>),
    /// A damper.
    Damper {
        /// c, N s/m.
        rate: f64,
        /// Where the rate changes, N.
        blow_off: f64,
        /// Rate from there on, N s/m.
        beyond: f64,
        /// Spring in series, N/m.
        series: Option<f64>,
    },
}

/// Force on the first body, its derivatives by d and ḋ, and the new (x, ẋ).
#[derive(Clone, Copy, Debug, Default)]
pub struct Answer {
    /// f, N.
    pub force: f64,
    /// ∂f/∂d, ∂f/∂ḋ.
    pub slopes: [f64; 2],
    /// x, ẋ.
    pub inner: [f64; 2],
}

impl Element {
    /// A stop with its points (m, N).
    pub fn stop(points: &[[f64; 2]]) -> Self {
        Self::Stop(points.to_vec())
    }

    /// A damper.
    pub fn damper(rate: f64, blow_off: Option<f64>, beyond: f64, series: Option<f64>) -> Self {
        Self::Damper { rate, blow_off: blow_off.unwrap_or(f64::INFINITY), beyond, series }
    }

    /// Answers the stretch `d` and its rate; `old` is (x, ẋ) at the begin of the step, γ and h are Newmark's.
    pub fn answer(&self, d: f64, rate: f64, old: [f64; 2], gamma: f64, h: f64) -> Answer {
        match self {
            Self::Stop(points) => {
                let (force, slope) = along(points, d.abs());
                Answer { force: -force * d.signum(), slopes: [-slope, 0.0], inner: [0.0; 2] }
            }
            Self::Damper { rate: c, blow_off, beyond, series: None } => {
                let (force, slope) = damping(*c, *blow_off, *beyond, rate);
                Answer { force: -force, slopes: [0.0, -slope], inner: [0.0; 2] }
            }
            Self::Damper { rate: c, blow_off, beyond, series: Some(k) } => {
                // D(w) = k (e − γh w),  e = d − x₀ − h(1 − γ)ẋ₀: two straight lines, one of which holds.
                let e = d - old[0] - h * (1.0 - gamma) * old[1];
                let soft = k * gamma * h;
                let first = k * e / (c + soft);
                let (w, slope) = if c * first.abs() <= *blow_off {
                    (first, *c)
                } else {
                    let knee = blow_off / c;
                    let past = (k * e.abs() - blow_off - soft * knee) / (beyond + soft);
                    ((knee + past) * e.signum(), *beyond)
                };
                let x = old[0] + h * ((1.0 - gamma) * old[1] + gamma * w);
                Answer { force: -k * (d - x), slopes: [-k * slope / (slope + soft), 0.0], inner: [x, w] }
            }
        }
    }
}

/// Value and slope of a line through points at x ≥ 0; zero before the first, the last slope behind the last.
fn along(points: &[[f64; 2]], x: f64) -> (f64, f64) {
    let after = points.partition_point(|point| point[0] <= x);
    let Some(i) = after.checked_sub(1) else { return (0.0, 0.0) };
    let i = i.min(points.len().saturating_sub(2));
    let [Some([x0, f0]), Some([x1, f1])] = [points.get(i), points.get(i + 1)] else { return (0.0, 0.0) };
    let slope = (f1 - f0) / (x1 - x0);
    (f0 + slope * (x - x0), slope)
}

/// D(w) and its slope.
fn damping(c: f64, blow_off: f64, beyond: f64, w: f64) -> (f64, f64) {
    if c * w.abs() <= blow_off {
        (c * w, c)
    } else {
        ((blow_off + beyond * (w.abs() - blow_off / c)) * w.signum(), beyond)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_has_its_points_and_its_last_slope() {
        let stop = Element::stop(&[[0.025, 0.0], [0.03, 600.0], [0.04, 3600.0]]);
        let force = |d: f64| stop.answer(d, 0.0, [0.0; 2], 0.5, 1e-3).force;
        assert_eq!((force(0.02), force(-0.0249)), (0.0, 0.0));
        for (d, f) in [(0.0275, 300.0), (0.035, 2100.0), (0.05, 6600.0)] {
            assert!((force(d) + f).abs() < 1e-9 && (force(-d) - f).abs() < 1e-9, "{d}");
        }
    }

    #[test]
    fn a_damper_in_series_is_the_rigid_one_for_a_stiff_spring_and_answers_its_slope() {
        let (c, blow_off, beyond) = (3e5, Some(3e3), 2e4);
        let rigid = Element::damper(c, blow_off, beyond, None);
        let stiff = Element::damper(c, blow_off, beyond, Some(1e13));
        for w in [0.001, 0.02, -0.05] {
            // From rest at x = 0 to a mean velocity of w/2 over the step: the damper ends with w.
            let h = 1e-3;
            let at = stiff.answer(0.5 * h * w, 0.0, [0.0; 2], 0.5, h);
            let force = rigid.answer(0.0, w, [0.0; 2], 0.5, h).force;
            assert!((at.force - force).abs() < 1e-3 * force.abs(), "{w}: {} {force}", at.force);
        }
        let soft = Element::damper(c, blow_off, beyond, Some(1e7));
        for d in [1e-4, 8e-4] {
            let force = |d: f64| soft.answer(d, 0.0, [1e-5, 0.01], 0.5, 1e-3);
            let numeric = (force(d + 1e-9).force - force(d - 1e-9).force) / 2e-9;
            assert!((numeric / force(d).slopes[0] - 1.0).abs() < 1e-5, "{d}");
        }
    }
}
