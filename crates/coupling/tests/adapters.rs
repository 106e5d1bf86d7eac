//! Bridges without velocities, at other places, several as one: each against a subsystem that lacks nothing.

mod spatial;

use spatial::{N, SUPPORTS, ports, sides};
use ttb_contract::{Component, Failure, Port, Ports, Signal, Subsystem};
use ttb_coupling::{Adapted, Joined, Lacks, Shape, Stations};

const H: f64 = 2e-3;

/// A deck with its velocities left out.
struct NoVelocities(spatial::Side);

impl Subsystem for NoVelocities {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        self.0.set_inputs(values, rates)
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        assert_eq!(outputs.len(), N);
        outputs.copy_from_slice(self.0.motion()[0]);
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.0.exit_initialization()
    }
    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
        self.0.step(t, h, may_restore)
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.0.save()
    }
    fn restore(&mut self) -> Result<(), Failure> {
        self.0.restore()
    }
    fn can_interpolate(&self) -> bool {
        true
    }
    fn can_derive(&self) -> bool {
        true
    }
    /// Any linear map of the seed will do.
    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        change.iter_mut().zip(seed).enumerate().for_each(|(i, (c, s))| *c = s * (i + 1) as f64);
        Ok(())
    }
    fn trial_instance(&mut self, inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
        let [_, mut deck] = sides(1.0);
        deck.set_inputs(inputs, None)?;
        deck.exit_initialization()?;
        Ok(Some(Box::new(NoVelocities(deck))))
    }
    fn output_name(&self, index: usize) -> String {
        format!("d[{index}]")
    }
    fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        let signals = ["a", "b"].map(|name| Signal { name: name.into(), unit: "m".into() });
        signals.into_iter().filter(wanted).collect()
    }
    fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
        row.copy_from_slice(&self.0.motion()[0][..row.len()]);
        Ok(())
    }
    fn name(&self) -> &str {
        "no velocities"
    }
}

/// Forces that grow by the step, and their rates.
fn forces(n: usize, count: usize) -> [Vec<f64>; 2] {
    let force = |step: usize| move |i: usize| 1e4 * ((i + 2) as f64 * step as f64 * 0.1).sin();
    let (now, next): (Vec<f64>, Vec<f64>) =
        ((0..count).map(force(n)).collect(), (0..count).map(force(n + 1)).collect());
    let rates = now.iter().zip(&next).map(|(a, b)| (b - a) / H).collect();
    [now, rates]
}

fn adapted(stations: Option<Stations>) -> Adapted<NoVelocities> {
    let [_, deck] = sides(1.0);
    Adapted::new(NoVelocities(deck), Lacks { points: SUPPORTS, components: 3, stations, velocities: true }, H)
}

#[test]
fn velocities_of_a_deck_that_integrates_by_the_trapezoidal_rule_are_its_own() {
    let ([_, mut whole], mut without) = (sides(1.0), adapted(None));
    let (mut a, mut b) = (vec![0.0; 2 * N], vec![1.0; 2 * N]);
    let [zero, _] = forces(0, N);
    for side in [&mut whole as &mut dyn Subsystem, &mut without] {
        side.set_inputs(&zero, None).expect("inputs");
    }
    without.get_outputs(&mut b).expect("motion");
    assert_eq!(b[N..], [0.0; N], "no velocity in equilibrium");
    whole.exit_initialization().and_then(|()| without.exit_initialization()).expect("start");
    for n in 0..50 {
        let [now, rates] = forces(n, N);
        // A step that is taken back leaves nothing behind.
        without.save().expect("saved");
        without.set_inputs(&now, None).and_then(|()| without.step(0.0, 3.0 * H, true)).expect("a step");
        without.restore().expect("restored");
        for side in [&mut whole as &mut dyn Subsystem, &mut without] {
            side.set_inputs(&now, Some(&rates)).and_then(|()| side.step(n as f64 * H, H, true)).expect("a step");
        }
        whole.get_outputs(&mut a).and_then(|()| without.get_outputs(&mut b)).expect("motion");
        let largest = a[N..].iter().fold(1e-6_f64, |most, v| most.max(v.abs()));
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() <= 1e-9 * largest), "{a:?} {b:?}");
    }
    let mut change = vec![0.0; 2 * N];
    without.derivative(&[1.0; N], &mut change).expect("derivative");
    for i in 0..N {
        assert_eq!((change[i], change[N + i]), ((i + 1) as f64, 2.0 / H * (i + 1) as f64));
    }
    assert_eq!((without.output_name(1), without.output_name(N + 1)), ("d[1]".into(), "d[1]".into()));
}

#[test]
fn a_deck_at_other_places_gets_and_gives_the_same_work_in_every_component() {
    let stations = Stations::new(&[0.0, 10.0], &[], &[1.0, 4.0, 7.0], Shape::Linear).expect("stations");
    let mut deck = adapted(Some(stations));
    let [now, rates] = forces(3, 9);
    deck.set_inputs(&now, None).and_then(|()| deck.exit_initialization()).expect("start");
    deck.set_inputs(&now, Some(&rates)).and_then(|()| deck.step(0.0, H, true)).expect("a step");
    let (mut ours, mut theirs) = (vec![0.0; 18], vec![0.0; N]);
    deck.get_outputs(&mut ours).expect("motion");
    deck.inner().get_outputs(&mut theirs).expect("its own");
    for component in 0..3 {
        let [a, b] = [theirs[2 * component], theirs[2 * component + 1]];
        for (i, x) in [0.1, 0.4, 0.7].into_iter().enumerate() {
            assert!((ours[3 * component + i] - (a + x * (b - a))).abs() < 1e-15);
            assert!(ours[9 + 3 * component + i].abs() > 0.0, "a velocity");
        }
    }
    // λᵀ W d' = (Wᵀ λ)ᵀ d' with the derivative, which is diagonal here.
    let mut change = vec![0.0; 18];
    deck.derivative(&now, &mut change).expect("derivative");
    let weights = [[0.9, 0.1], [0.6, 0.4], [0.3, 0.7]];
    for component in 0..3 {
        let at = |j: usize| -> f64 { (0..3).map(|i| weights[i][j] * now[3 * component + i]).sum() };
        let own = [0, 1].map(|j| (2 * component + j + 1) as f64 * at(j));
        let expected: Vec<f64> = weights.iter().map(|w| w[0] * own[0] + w[1] * own[1]).collect();
        for i in 0..3 {
            assert!((change[3 * component + i] - expected[i]).abs() < 1e-9 * expected[i].abs());
        }
    }
    assert_eq!(deck.output_name(4), "motion of the deck at support 2");
    let mut another = deck.trial_instance(&now).expect("possible").expect("another");
    let mut again = vec![0.0; 18];
    another.set_inputs(&now, Some(&rates)).and_then(|()| another.step(0.0, H, false)).expect("a step");
    another.get_outputs(&mut again).expect("motion");
    assert_eq!(ours, again);
}

/// A deck that returns its forces: positions f, rates 2 f; it has two supports.
struct Echo(&'static str, Vec<f64>);

impl Subsystem for Echo {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        assert!(rates.is_none_or(|rates| rates.len() == 2));
        self.1 = values.to_vec();
        Ok(())
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        for (i, f) in self.1.iter().enumerate() {
            (outputs[i], outputs[2 + i]) = (*f, 2.0 * f);
        }
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn step(&mut self, _t: f64, _h: f64, _may_restore: bool) -> Result<(), Failure> {
        Ok(())
    }
    fn save(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Failure> {
        Ok(())
    }
    fn can_interpolate(&self) -> bool {
        true
    }
    fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
        self.1 = seed.to_vec();
        self.get_outputs(change)
    }
    fn trial_instance(&mut self, inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
        Ok(Some(Box::new(Echo("another", inputs.to_vec()))))
    }
    fn output_name(&self, index: usize) -> String {
        format!("{}.q[{index}]", self.0)
    }
    fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        let signal = Signal { name: "point[mid].displacement".into(), unit: "m".into() };
        if wanted(&signal) { vec![signal] } else { Vec::new() }
    }
    fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
        row[0] = self.1[0];
        Ok(())
    }
    fn name(&self) -> &str {
        self.0
    }
    fn seconds(&self) -> f64 {
        1.5
    }
}

#[test]
fn several_bridges_are_one_whose_positions_come_before_its_rates() {
    let two = || Ports::vertical(2, 1e5);
    let bridges = ["first", "second"].map(|name| (Echo(name, Vec::new()), two())).into_iter().collect();
    let mut joined = Joined::new(bridges).expect("complete ports");
    assert_eq!((joined.ports().forces(), joined.ranges(), joined.name()), (4, vec![0..2, 2..4], "first + second"));
    joined.set_inputs(&[1.0, 2.0, 3.0, 4.0], Some(&[0.0; 4])).expect("inputs");
    let mut motion = [0.0; 8];
    joined.get_outputs(&mut motion).expect("motion");
    assert_eq!(motion, [1.0, 2.0, 3.0, 4.0, 2.0, 4.0, 6.0, 8.0]);
    let names: Vec<String> = [1, 2, 5, 7].map(|i| joined.output_name(i)).to_vec();
    assert_eq!(names, ["first.q[1]", "second.q[0]", "first.q[3]", "second.q[3]"]);
    let signals = joined.record(&|_| true);
    let names: Vec<&str> = signals.iter().map(|signal| signal.name.as_str()).collect();
    assert_eq!(names, ["first.point[mid].displacement", "second.point[mid].displacement"]);
    let mut row = [0.0; 2];
    joined.read(&mut row).expect("a row");
    assert_eq!((row, joined.seconds()), ([1.0, 3.0], 3.0));
    joined.derivative(&[5.0, 6.0, 7.0, 8.0], &mut motion).expect("derivative");
    assert_eq!(motion, [5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 14.0, 16.0]);
    let mut another = joined.trial_instance(&[1.0, 0.0, 0.0, 9.0]).expect("possible").expect("another");
    another.get_outputs(&mut motion).expect("motion");
    assert_eq!(motion, [1.0, 0.0, 0.0, 9.0, 2.0, 0.0, 0.0, 18.0]);
    assert!(!joined.can_derive() && joined.can_roll_back());
}

#[test]
fn several_bridges_need_position_and_rate_of_every_port() {
    let known = ttb_contract::Known::Position;
    let incomplete = Ports::new(vec![Port { known, ..Port::new(1, Component::Vertical, 1.0) }], 0).expect("a port");
    let bridge = |ports: &Ports| (Echo("bridge", Vec::new()), ports.clone());
    assert!(Joined::new(vec![bridge(&incomplete), bridge(&ports(1.0))]).is_none());
    assert!(Joined::new(vec![bridge(&incomplete)]).is_some());
}
