//! Keeps the histories that criteria judge during a run, every step, whichever FMUs take it.
//!
//! Of a bridge of ours the deck is looked at under the track's supports, at those nearest to 24 equal parts of every span: their
//! motions are coupled anyway, and nothing is added to the FMU.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use ttb_assessment::reduce::{AxleHistory, CarHistory, Histories, LATERAL, PointHistory, SHIFT, SIDES, acceleration};
use ttb_campaign::points::deck_points;
use ttb_contract::Component;
use ttb_scenario::Checked;
use ttb_scenario::spec::{BridgeSpec, Vehicle};
use ttb_scenario::types::Direction;
use ttb_session::column::Column;
use ttb_session::{Begin, Moment, Observer, Of, Quantity, RunError};

use crate::results::scene::Scene;

/// An observer that keeps what is judged.
#[derive(Default)]
pub struct Watch {
    time: Vec<f64>,
    kept: Vec<Kept>,
    /// Numbers of supports that are points of the deck, and their abscissas, m.
    deck: BTreeMap<usize, f64>,
}

/// Supports whose motions are read.
pub struct Supports(Vec<usize>);

impl Supports {
    /// Whether a column is a motion of one of them.
    pub fn contains(&self, column: &Column) -> bool {
        let is = |number| self.0.binary_search(number).is_ok();
        matches!(&column.of, Of::Support(number) if is(number)) && is_motion(column)
    }
}

fn is_motion(column: &Column) -> bool {
    let own = matches!(column.quantity, Quantity::Displacement | Quantity::Velocity);
    column.instance.is_none() && (own || [ROTATION, SWAY].contains(&column.quantity.name()))
}

/// Motions of the deck in space under a support.
const ROTATION: &str = Component::Roll.position();
const SWAY: &str = Component::Lateral.position();

struct Kept {
    at: usize,
    column: Column,
    values: Vec<f64>,
}

fn is_judged(column: &Column, deck: &BTreeMap<usize, f64>) -> bool {
    use Quantity as Q;
    match column.of {
        Of::Support(number) => deck.contains_key(&number) && is_motion(column),
        Of::Point(_) => matches!(column.quantity, Q::Displacement | Q::Acceleration | Q::Moment),
        Of::Wheel(_) => {
            matches!(column.quantity, Q::ContactForce | Q::Position)
                || column.quantity.name() == SHIFT
                || SIDES.iter().flatten().any(|name| column.quantity.name() == *name)
        }
        Of::Car(_) => {
            matches!(column.quantity, Q::Acceleration | Q::PitchAcceleration) || column.quantity.name() == LATERAL
        }
        _ => false,
    }
}

impl Observer for Watch {
    fn start(&mut self, begin: &Begin) -> Result<(), RunError> {
        let judged = begin.columns.iter().enumerate().filter(|(_, column)| is_judged(column, &self.deck));
        self.kept = judged.map(|(at, column)| Kept { at, column: column.clone(), values: Vec::new() }).collect();
        Ok(())
    }

    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        self.time.push(moment.t);
        for kept in &mut self.kept {
            kept.values.push(moment.row[kept.at]);
        }
        Ok(ControlFlow::Continue(()))
    }
}

impl Watch {
    /// For a scenario with its own bridge; of any other the named points alone are looked at.
    pub fn of(checked: Option<&Checked>) -> Self {
        Self { deck: checked.map(|checked| on_deck(&checked.bridge)).unwrap_or_default(), ..Self::default() }
    }

    /// The supports whose motions it needs.
    pub fn supports(&self) -> Supports {
        Supports(self.deck.keys().copied().collect())
    }

    /// The histories; what a scenario knows of its train, its deck and its points is told to them. Of wheelsets without a
    /// scenario the force of the first row is the static one.
    pub fn histories(self, checked: Option<&Checked>, scene: &Scene) -> Histories {
        let mut histories = Histories { time: self.time, bridge: scene.deck, ..Histories::default() };
        let h = match histories.time[..] {
            [first, .., last] => (last - first) / (histories.time.len() - 1) as f64,
            _ => f64::NAN,
        };
        let vehicles = checked.map(|checked| checked.train_track.consist()).unwrap_or_default();
        let loads: Vec<f64> = vehicles.iter().flat_map(Vehicle::axles).map(|[load, _]| load).collect();
        // Outputs count the vehicles that have a body.
        let with_bodies = |vehicle: &&Vehicle| !matches!(vehicle, Vehicle::Bodies(v) if v.bodies.is_empty());
        let cars: Vec<&Vehicle> = vehicles.iter().filter(with_bodies).collect();
        for Kept { column, values, .. } in self.kept {
            match &column.of {
                Of::Point(name) if belongs_to_deck(name, checked) => {
                    let full = column.instance.as_ref().map_or_else(|| name.clone(), |of| format!("{of}.{name}"));
                    let point = of(
                        &mut histories.points,
                        |point| point.name == full,
                        || PointHistory {
                            x: checked.and_then(|checked| checked.bridge.points.iter().find(|p| p.name == *name)?.x),
                            name: full.clone(),
                            ..PointHistory::default()
                        },
                    );
                    match column.quantity {
                        Quantity::Displacement => point.displacement = values,
                        Quantity::Acceleration => point.acceleration = values,
                        _ => point.moment = values,
                    }
                }
                Of::Support(number) if [ROTATION, SWAY].contains(&column.quantity.name()) => {
                    let supports = &mut histories.supports;
                    if let Some(x) = self.deck.get(number).filter(|x| supports.x.last().is_none_or(|last| *x > last)) {
                        supports.x.push(*x);
                    }
                    let turns = column.quantity.name() == ROTATION;
                    if turns { &mut supports.rotation } else { &mut supports.lateral }.push(values);
                }
                Of::Support(number) => {
                    let x = self.deck.get(number).copied();
                    let point =
                        of(&mut histories.deck, |point| point.x == x, || PointHistory { x, ..PointHistory::default() });
                    match column.quantity {
                        Quantity::Displacement => point.displacement = values,
                        _ => point.acceleration = acceleration(&values, h),
                    }
                }
                Of::Wheel(number) => {
                    let known = number.checked_sub(1).and_then(|at| loads.get(at)).copied();
                    let axle = of(
                        &mut histories.axles,
                        |axle| axle.number == *number,
                        || AxleHistory { number: *number, ..AxleHistory::default() },
                    );
                    match &column.quantity {
                        Quantity::ContactForce => {
                            axle.static_load = known.or_else(|| values.first().copied()).unwrap_or(0.0);
                            axle.force = values;
                        }
                        Quantity::Position => axle.position = values,
                        other if other.name() == SHIFT => axle.sides.shift = values,
                        other => {
                            for (side, [lateral, vertical]) in SIDES.into_iter().enumerate() {
                                if other.name() == lateral {
                                    axle.sides.lateral[side].clone_from(&values);
                                } else if other.name() == vertical {
                                    axle.sides.vertical[side].clone_from(&values);
                                }
                            }
                        }
                    }
                }
                Of::Car(number) => {
                    let base = number.checked_sub(1).and_then(|at| match cars.get(at) {
                        Some(Vehicle::Car(car)) => Some(0.5 * car.bogie_distance),
                        _ => None,
                    });
                    let car = of(
                        &mut histories.cars,
                        |car| car.number == *number,
                        || CarHistory { number: *number, half_base: base, ..CarHistory::default() },
                    );
                    match &column.quantity {
                        Quantity::Acceleration => car.acceleration = values,
                        Quantity::PitchAcceleration => car.pitch_acceleration = values,
                        _ => car.lateral_acceleration = values,
                    }
                }
                _ => {}
            }
        }
        histories
    }
}

/// Supports nearest to equal parts of every span, and where they are.
fn on_deck(bridge: &BridgeSpec) -> BTreeMap<usize, f64> {
    let nearest = |x: f64| {
        let places = bridge.supports.iter().enumerate();
        let (at, place) = places.min_by(|a, b| (a.1 - x).abs().total_cmp(&(b.1 - x).abs()))?;
        Some((at + 1, *place))
    };
    deck_points(&bridge.structure).into_iter().filter_map(nearest).collect()
}

/// Whether a point carries track and moves down: by its abscissa; a node of a model may be anywhere. Of a foreign bridge every point counts.
fn belongs_to_deck(name: &str, checked: Option<&Checked>) -> bool {
    let known = checked.and_then(|checked| checked.bridge.points.iter().find(|point| point.name == *name));
    known.is_none_or(|point| point.node.is_none() && point.direction != Direction::Y)
}

/// The member of a list that fits, or a new one.
fn of<T>(list: &mut Vec<T>, fits: impl Fn(&T) -> bool, new: impl FnOnce() -> T) -> &mut T {
    let at = list.iter().position(fits).unwrap_or_else(|| {
        list.push(new());
        list.len() - 1
    });
    &mut list[at]
}
