//! Any linear bridge, by one axle a speed: all degrees of freedom, dashpots, an FMU of another program.
//!
//! ```text
//! u(t)    the response to one unit axle that enters the deck at t = 0
//! y(t)  = Σ_i P_i u(t − x_i/v)                    every train at the speed v
//! u between samples: the cubic with values u and slopes u̇ at both ends (Hermite)
//! ```
//!
//! The axle acts on the track's supports by weights of its place, cubic between supports, so that forces vary smoothly;
//! where no support stands at an end of the deck, it reaches the ground there. Displacements have their velocities as
//! slopes; those of accelerations and moments come from five samples, h⁴, on one side of the instants at which the axle
//! comes onto the deck and leaves it: both are samples. An acceleration that the bridge does not tell comes from its
//! velocity the same way.
//!
//! Error of the superposition: that of the cubic through every third sample, seen at the samples between, is 64 times
//! larger; [`Unit::errors`] tells a sixty-fourth of it, relative to the largest value of each output. Displacements stay
//! below 1e-4 where a step is a twentieth of the shortest period that matters. A moment has a kink when the axle passes, and
//! an acceleration holds frequencies that no step resolves if the bridge's damping leaves them: their errors are larger.

use ttb_contract::{Component, Failure, Known, Ports, Subsystem};
use ttb_trains::ForceTrain;

use crate::extreme::Extreme;
use crate::lines::Lines;
use crate::passage::Response;
use crate::place::{Output, Place, PlaceKind, Quantity};
use crate::source::stations;

/// The unit axle, N: of the size that programs expect.
const UNIT: f64 = 1e5;
/// Distance of deck points at most, and parts of the deck at least.
const POINTS: f64 = 1.25;
const PARTS: usize = 20;

/// A deck as the axle meets it.
#[derive(Clone, Debug)]
pub struct Path {
    /// Weights of the ports by place.
    weights: Lines,
    /// Input of every line, `None` where it goes to the ground.
    inputs: Vec<Option<usize>>,
    forces: usize,
    length: f64,
    /// Whether the axle enters at the deck's end.
    backward: bool,
    /// Deck points: number of the port, abscissa.
    points: Vec<(usize, f64)>,
    rates: usize,
    motions: usize,
    /// Outputs of the bridge that are deck points under another name.
    named: Vec<(String, f64)>,
}

impl Path {
    /// A deck of `length` m; `supports` are the abscissae of the supports by their number (from 1), m from the deck's
    /// begin. Where no support stands at an end of the deck or at one of the inner `bearings`, m, the axle reaches the
    /// ground.
    ///
    /// # Errors
    /// No vertical force on the deck among the ports.
    pub fn new(ports: &Ports, supports: &[f64], length: f64, bearings: &[f64]) -> Result<Self, Failure> {
        const NEAR: f64 = 1e-6;
        let vertical = ports.list().iter().enumerate().filter(|(_, port)| port.component == Component::Vertical);
        let mut carried: Vec<(usize, f64, Known)> = vertical
            .filter_map(|(i, port)| Some((i, *supports.get(port.support.checked_sub(1)?)?, port.known)))
            .filter(|(_, x, _)| *x >= -NEAR && *x <= length + NEAR)
            .collect();
        carried.sort_by(|a, b| a.1.total_cmp(&b.1));
        carried.dedup_by(|a, b| (a.1 - b.1).abs() < NEAR);
        if carried.is_empty() {
            return Err(refused("the bridge has no vertical force of a support on its deck"));
        }
        let taken = |x: f64| carried.iter().any(|(_, support, _)| (support - x).abs() < NEAR);
        let ends = [0.0, length];
        let ground = ends.iter().chain(bearings).copied().filter(|x| !taken(*x));
        let mut places: Vec<(f64, Option<usize>)> = ground.map(|x| (x, None)).collect();
        places.extend(carried.iter().map(|(i, x, _)| (*x, Some(*i))));
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        places.dedup_by(|a, b| (a.0 - b.0).abs() < NEAR);
        let (breaks, inputs): (Vec<f64>, Vec<Option<usize>>) = places.into_iter().unzip();
        if breaks.len() < 2 {
            return Err(refused("the bridge has one support alone: no axle can run over it"));
        }
        let unit = |i: usize| (0..breaks.len()).map(|k| f64::from(u8::from(k == i))).collect::<Vec<f64>>();
        let functions: Vec<Vec<f64>> = (0..breaks.len()).map(unit).collect();
        let known: Vec<(usize, f64)> =
            carried.iter().filter(|(.., known)| *known == Known::PositionAndRate).map(|(i, x, _)| (*i, *x)).collect();
        let parts = |length: f64| PARTS.max((length / POINTS).ceil() as usize);
        let wanted = stations(&[[0.0, length]], parts);
        let nearest = |x: &f64| known.iter().min_by(|a, b| (a.1 - x).abs().total_cmp(&(b.1 - x).abs())).copied();
        let mut points: Vec<(usize, f64)> = wanted.iter().filter_map(nearest).collect();
        points.dedup();
        Ok(Self {
            weights: Lines::through(breaks, &functions),
            inputs,
            forces: ports.forces(),
            length,
            backward: false,
            points,
            rates: ports.positions(),
            motions: ports.motions(),
            named: Vec::new(),
        })
    }

    /// Names of monitored points that are deck points, with their abscissae, m; the supports are then no deck points.
    #[must_use]
    pub fn with_deck_points(mut self, named: Vec<(String, f64)>) -> Self {
        self.points.clear();
        self.named = named;
        self
    }

    /// The same deck with the axle entering at its end.
    #[must_use]
    pub fn backward(&self) -> Self {
        Self { backward: !self.backward, ..self.clone() }
    }

    /// Forces of the unit axle that has run `x` m since it came onto the deck.
    fn forces(&self, x: f64, forces: &mut [f64]) {
        forces.fill(0.0);
        if !(0.0..=self.length).contains(&x) {
            return;
        }
        let x = if self.backward { self.length - x } else { x };
        for (weight, input) in self.weights.at(x).into_iter().zip(&self.inputs) {
            if let Some(input) = input {
                forces[*input] += UNIT * weight;
            }
        }
    }
}

/// Response to one unit axle (1 N) at one speed.
#[derive(Clone, Debug)]
pub struct Unit {
    /// Speed, m/s.
    pub speed: f64,
    /// Step, s.
    pub h: f64,
    /// What was looked at.
    pub outputs: Vec<Output>,
    /// Error of the superposition of each output, relative to its largest value.
    pub errors: Vec<f64>,
    length: f64,
    values: Vec<Vec<f64>>,
    /// Slopes behind and before each sample.
    rates: Vec<[Vec<f64>; 2]>,
}

/// A history while it is recorded, and what its slopes are.
struct Recorded {
    output: Output,
    value: Vec<f64>,
    rate: Option<Vec<f64>>,
}

impl Unit {
    /// Runs one axle at `speed` m/s over a bridge in initialization mode at rest, in steps of at most `h` s, of which a whole
    /// number takes the axle over the deck, for `time` s; a train of length l and free vibration of f s need
    /// (length + l)/v + f.
    ///
    /// # Errors
    /// The bridge fails or answers with a number that is not finite.
    pub fn run(bridge: &mut dyn Subsystem, path: &Path, speed: f64, h: f64, time: f64) -> Result<Self, Failure> {
        let across = (path.length / (speed * h)).ceil().max(1.0) as usize;
        let h = path.length / (speed * across as f64);
        let steps = (time / h).ceil() as usize + 2;
        let kinks = [0, across];
        let signals = bridge.record(&|signal| parsed(&signal.name).is_some());
        let mut row = vec![0.0; signals.len()];
        let mut histories: Vec<Vec<f64>> = vec![vec![0.0]; signals.len()];
        let mut motions = vec![0.0; path.motions];
        let mut deck: Vec<[Vec<f64>; 2]> = vec![[vec![0.0], vec![0.0]]; path.points.len()];
        let [mut now, mut next, mut rates] = [(); 3].map(|()| vec![0.0; path.forces]);
        bridge.set_inputs(&now, None)?;
        bridge.exit_initialization()?;
        for n in 0..steps {
            let t = n as f64 * h;
            path.forces(speed * t, &mut now);
            path.forces(speed * (t + h), &mut next);
            if bridge.can_interpolate() {
                rates.iter_mut().zip(now.iter().zip(&next)).for_each(|(r, (a, b))| *r = (b - a) / h);
                bridge.set_inputs(&now, Some(&rates))?;
            } else {
                // Held: the mean over the step.
                now.iter_mut().zip(&next).for_each(|(a, b)| *a = 0.5 * (*a + b));
                bridge.set_inputs(&now, None)?;
            }
            bridge.step(t, h, false)?;
            bridge.get_outputs(&mut motions)?;
            bridge.read(&mut row)?;
            for ((port, _), [u, v]) in path.points.iter().zip(&mut deck) {
                u.push(motions[*port] / UNIT);
                v.push(motions[path.rates + port] / UNIT);
            }
            histories.iter_mut().zip(&row).for_each(|(history, value)| history.push(value / UNIT));
            if let Some(bad) = motions.iter().chain(&row).find(|value| !value.is_finite()) {
                return Err(Failure::new(bridge.name(), format!("it answers {bad} at {t} s")));
            }
        }
        let mut recorded = Vec::new();
        for ((_, x), [u, v]) in path.points.iter().zip(deck) {
            let place = Place::on_deck(*x, "");
            let acceleration = Output { quantity: Quantity::Acceleration, place: place.clone() };
            recorded.push(Recorded { output: acceleration, value: one(slopes(&v, h, kinks)), rate: None });
            let displacement = Output { quantity: Quantity::Displacement, place };
            recorded.push(Recorded { output: displacement, value: u, rate: Some(v) });
        }
        for (signal, value) in signals.iter().zip(&histories) {
            let Some((name, Some(quantity))) = parsed(&signal.name) else { continue };
            let on_deck = path.named.iter().find(|(known, _)| known == name);
            let place = match on_deck {
                Some((_, x)) => Place::on_deck(*x, ""),
                None => Place { kind: PlaceKind::Point, name: name.into(), x: None },
            };
            let velocity = signals.iter().position(|other| parsed(&other.name) == Some((name, None)));
            let rate = velocity.filter(|_| quantity == Quantity::Displacement).map(|i| histories[i].clone());
            recorded.push(Recorded { output: Output { quantity, place }, value: value.clone(), rate });
        }
        // In the order of the modal way: accelerations come last.
        let order = |recorded: &Recorded| match recorded.output.quantity {
            Quantity::Acceleration => 1,
            _ => 0,
        };
        recorded.sort_by_key(|r| (order(r), r.output.quantity));
        Ok(Self::of(recorded, speed, h, path.length, kinks))
    }

    fn of(recorded: Vec<Recorded>, speed: f64, h: f64, length: f64, kinks: [usize; 2]) -> Self {
        let mut unit =
            Self { speed, h, outputs: Vec::new(), errors: Vec::new(), length, values: Vec::new(), rates: Vec::new() };
        for Recorded { output, value, rate } in recorded {
            let rate = rate.map_or_else(|| slopes(&value, h, kinks), |rate| [rate.clone(), rate]);
            unit.errors.push(error(&value, &rate, h, kinks[1]));
            unit.outputs.push(output);
            unit.values.push(value);
            unit.rates.push(rate);
        }
        unit
    }

    /// Histories of all outputs under a train, from its first axle at the deck's begin until `free` s behind its last at the
    /// end.
    #[must_use]
    pub fn histories(&self, train: &ForceTrain, free: f64) -> Vec<Vec<f64>> {
        let time = (self.length + train.length()) / self.speed + free;
        let samples = (time / self.h).ceil() as usize + 1;
        let outputs = self.values.iter().zip(&self.rates);
        outputs.map(|(value, rate)| self.superposed(value, rate, train, samples)).collect()
    }

    fn superposed(&self, value: &[f64], rate: &[Vec<f64>; 2], train: &ForceTrain, samples: usize) -> Vec<f64> {
        let mut y = vec![0.0; samples];
        for axle in &train.axles {
            let delay = axle.x / (self.speed * self.h);
            let whole = delay.floor() as usize;
            let theta = 1.0 - (delay - whole as f64);
            let weights = hermite(theta, self.h).map(|w| axle.load * w);
            if whole + 1 > samples {
                continue;
            }
            // y_n takes the sample pair (m, m + 1) with m = n − whole − 1.
            let pairs = value.windows(2).zip(&rate[0]).zip(&rate[1][1..]);
            for (y, ((u, v0), v1)) in y[(whole + 1).min(samples)..].iter_mut().zip(pairs) {
                *y += (weights[0] * u[0] + weights[1] * v0) + (weights[2] * u[1] + weights[3] * v1);
            }
        }
        y
    }

    /// Extremes of all outputs under a train.
    #[must_use]
    pub fn response(&self, train: &ForceTrain, free: f64) -> Response {
        let histories = self.histories(train, free);
        let steps = histories.first().map_or(0, |history| history.len().saturating_sub(1));
        let extremes = histories.iter().map(|history| Extreme::of(history, self.h)).collect();
        Response { speed: self.speed, step: self.h, steps, extremes }
    }
}

/// Weights of u₀, u̇₀, u₁, u̇₁ at θ between two samples.
fn hermite(theta: f64, h: f64) -> [f64; 4] {
    let (t2, t3) = (theta * theta, theta * theta * theta);
    [1.0 - 3.0 * t2 + 2.0 * t3, h * (theta - 2.0 * t2 + t3), 3.0 * t2 - 2.0 * t3, h * (t3 - t2)]
}

/// Slopes behind and before each sample, of order four, from samples on one side of the kinks.
fn slopes(y: &[f64], h: f64, kinks: [usize; 2]) -> [Vec<f64>; 2] {
    /// Weights of five samples for the slope at the first, second and third of them, times 12.
    const WEIGHTS: [[f64; 5]; 3] =
        [[-25.0, 48.0, -36.0, 16.0, -3.0], [-3.0, -10.0, 18.0, -6.0, 1.0], [1.0, -8.0, 0.0, 8.0, -1.0]];
    let mut sides = [vec![0.0; y.len()], vec![0.0; y.len()]];
    let ends = [kinks[0], kinks[1], y.len() - 1];
    for range in ends.windows(2).filter(|range| range[0] < range[1]) {
        let [from, to] = [range[0], range[1]];
        let slope = |n: usize| {
            if to - from < 4 {
                return (y[to] - y[from]) / ((to - from) as f64 * h);
            }
            let (before, behind) = (n - from, to - n);
            let dot = |weights: [f64; 5], at: &dyn Fn(usize) -> f64| -> f64 {
                weights.iter().enumerate().map(|(i, w)| w * at(i)).sum::<f64>() / (12.0 * h)
            };
            match (before, behind) {
                (0 | 1, _) => dot(WEIGHTS[before], &|i| y[from + i]),
                (_, 0 | 1) => -dot(WEIGHTS[behind], &|i| y[to - i]),
                _ => dot(WEIGHTS[2], &|i| y[n - 2 + i]),
            }
        };
        (from..to).for_each(|n| sides[0][n] = slope(n));
        (from + 1..=to).for_each(|n| sides[1][n] = slope(n));
    }
    sides
}

/// One slope a sample, that before it.
fn one([behind, before]: [Vec<f64>; 2]) -> Vec<f64> {
    let first = behind.first().copied().unwrap_or(0.0);
    std::iter::once(first).chain(before.into_iter().skip(1)).collect()
}

/// Error of the cubics, relative to the largest value: a sixty-fourth of the error of those three steps long at the samples
/// inside them, as error grows with h⁴ θ²(1 − θ)². In the middle of two steps Newmark's method meets the cubic whatever its
/// error. `kink` is no inner sample of such a cubic.
fn error(value: &[f64], [behind, before]: &[Vec<f64>; 2], h: f64, kink: usize) -> f64 {
    let largest = value.iter().fold(0.0_f64, |most, y| most.max(y.abs()));
    if largest == 0.0 || value.len() < 4 {
        return 0.0;
    }
    let inner = (0..value.len() - 3).filter(|n| !(n + 1..n + 3).contains(&kink));
    let miss = inner.flat_map(|n| {
        [1, 2].map(|i| {
            let [u0, v0, u1, v1] = hermite(i as f64 / 3.0, 3.0 * h);
            let cubic = (u0 * value[n] + v0 * behind[n]) + (u1 * value[n + 3] + v1 * before[n + 3]);
            (cubic - value[n + i]).abs()
        })
    });
    miss.fold(0.0, f64::max) / (64.0 * largest)
}

/// Name and quantity of `point[NAME].quantity`; of a velocity no quantity.
fn parsed(name: &str) -> Option<(&str, Option<Quantity>)> {
    let (point, quantity) = name.strip_prefix("point[")?.split_once("].")?;
    let quantity = match quantity {
        "displacement" => Some(Quantity::Displacement),
        "velocity" => None,
        "acceleration" => Some(Quantity::Acceleration),
        "moment" => Some(Quantity::Moment),
        _ => return None,
    };
    Some((point, quantity))
}

fn refused(what: &str) -> Failure {
    Failure::new("bridge", what)
}
