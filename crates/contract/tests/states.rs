//! Saved states as bytes: damage and impossible parameters are refused, and the instance goes on as if nobody had asked.

use std::path::Path;

use ttb_contract::{Instance, Interface, Model, ModelError, Values, Variable};

/// y ← y + gain u h. A gain of −1 cannot be, and the build that finds it leaves it behind.
struct Sum {
    interface: Interface,
    gain: f64,
    sum: f64,
}

impl Sum {
    fn new() -> Self {
        let interface = Interface::new(
            vec![Variable::input("u", "1", "")],
            vec![Variable::output("y", "1", "")],
            vec![Variable::parameter("gain", "1", 1.0, "")],
        );
        Self { interface, gain: 0.0, sum: 0.0 }
    }
}

impl Model for Sum {
    type State = f64;

    fn load(_: &Path) -> Result<Self, ModelError> {
        Ok(Self::new())
    }

    fn interface(&self) -> &Interface {
        &self.interface
    }

    fn default_experiment(&self) -> (f64, f64) {
        (0.1, 1.0)
    }

    fn build(&mut self, values: &Values, _start: f64) -> Result<(), ModelError> {
        (self.gain, self.sum) = (values.all[2], 0.0);
        if self.gain == -1.0 { Err(ModelError("a gain of -1 cannot be".into())) } else { Ok(()) }
    }

    fn equilibrium(&mut self, values: &mut Values) -> Result<(), ModelError> {
        values.all[1] = 0.0;
        Ok(())
    }

    fn start(&mut self, _values: &mut Values) -> Result<(), ModelError> {
        Ok(())
    }

    fn step(&mut self, values: &mut Values, _t: f64, h: f64) -> Result<(), ModelError> {
        self.sum += self.gain * values.all[0] * h;
        values.all[1] = self.sum;
        Ok(())
    }

    fn save(&self) -> f64 {
        self.sum
    }

    fn restore(&mut self, state: &f64) {
        self.sum = *state;
    }

    fn write_state(&self, state: &f64, bytes: &mut Vec<u8>) {
        bytes.extend(state.to_le_bytes());
    }

    fn read_state(&self, bytes: &[u8]) -> Result<f64, ModelError> {
        let number = bytes.try_into().map_err(|_| ModelError("a state of another length".into()))?;
        Ok(f64::from_le_bytes(number))
    }
}

/// After a step of 0.5 with u = 4 under a gain.
fn running(gain: f64) -> Instance<Sum> {
    let mut instance = Instance::new(Sum::new());
    instance.set(&[2], &[gain]).unwrap();
    instance.enter_initialization(0.0).unwrap();
    instance.exit_initialization().unwrap();
    instance.set(&[0], &[4.0]).unwrap();
    instance.step(0.0, 0.5).unwrap();
    instance
}

fn output(instance: &mut Instance<Sum>) -> f64 {
    let mut y = [0.0];
    instance.get(&[1], &mut y).unwrap();
    y[0]
}

/// The sum of 64 bits at the end, as the format has it.
fn summed(mut body: Vec<u8>) -> Vec<u8> {
    let mut sum = 0xcbf2_9ce4_8422_2325_u64;
    for byte in &body {
        sum = (sum ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
    }
    body.extend(sum.to_le_bytes());
    body
}

#[test]
fn bytes_carry_a_run_into_an_instance_with_other_parameters_and_back() {
    let (mut a, mut b) = (running(3.0), running(5.0));
    let bytes = a.to_bytes(&a.save());
    let snapshot = b.from_bytes(&bytes).unwrap();
    // Reading alone changes nothing.
    b.step(0.5, 0.5).unwrap();
    assert_eq!(output(&mut b), 20.0);
    b.restore(&snapshot).unwrap();
    [&mut a, &mut b].into_iter().for_each(|instance| instance.step(0.5, 0.5).unwrap());
    assert_eq!([output(&mut a), output(&mut b)], [12.0; 2]);
}

#[test]
fn every_damaged_byte_is_refused() {
    let mut instance = running(3.0);
    let bytes = instance.to_bytes(&instance.save());
    for at in 0..bytes.len() {
        for bit in 0..8 {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << bit;
            assert!(instance.from_bytes(&damaged).is_err(), "byte {at}, bit {bit}");
        }
    }
    for length in 0..bytes.len() {
        assert!(instance.from_bytes(&bytes[..length]).is_err(), "{length} bytes");
    }
    instance.step(0.5, 0.5).unwrap();
    assert_eq!(output(&mut instance), 12.0);
}

#[test]
fn what_could_not_be_set_is_not_restored_either() {
    let mut instance = running(3.0);
    let bytes = instance.to_bytes(&instance.save());
    let body = &bytes[..bytes.len() - 8];
    assert!(instance.from_bytes(&summed(body.to_vec())).is_ok());
    // After mark (8) and flags (5): start, time, u, y, gain, rate of u, and the state.
    let place = |number: usize| 13 + 8 * number;
    let forge = |number: usize, value: f64| {
        let mut body = body.to_vec();
        body[place(number)..place(number) + 8].copy_from_slice(&value.to_le_bytes());
        summed(body)
    };
    for (number, value, what) in [
        (0, f64::NAN, "stands"),
        (1, f64::NEG_INFINITY, "stands"),
        (2, f64::INFINITY, "u is"),
        (3, f64::NAN, "y is"),
        (4, f64::NAN, "gain is"),
        (4, -1.0, "cannot be"),
        (5, f64::NAN, "derivative of u"),
    ] {
        let error = instance.from_bytes(&forge(number, value)).err().expect("refused").0;
        assert!(error.contains(what), "{error}");
    }
    // Phase, flags, and lengths that fit no phase.
    for (at, value, what) in [(8, 3, "phase 3"), (9, 2, "a flag is 2"), (11, 255, "a flag is 255"), (12, 0, "8 bytes")]
    {
        let mut body = body.to_vec();
        body[at] = value;
        let error = instance.from_bytes(&summed(body)).err().expect("refused").0;
        assert!(error.contains(what), "{error}");
    }
    let mut without_state = body[..body.len() - 8].to_vec();
    without_state[12] = 0;
    let error = instance.from_bytes(&summed(without_state)).err().expect("refused").0;
    assert!(error.contains("holds no state"), "{error}");
    instance.step(0.5, 0.5).unwrap();
    assert_eq!(output(&mut instance), 12.0);
}

#[test]
fn a_state_that_cannot_be_restored_leaves_the_instance_as_it_was() {
    let mut instance = running(3.0);
    let mut other = Instance::new(Sum::new());
    other.set(&[2], &[2.0]).unwrap();
    other.enter_initialization(0.0).unwrap();
    // Set after the build: the snapshot carries a gain that cannot be.
    other.set(&[2], &[-1.0]).unwrap();
    let error = instance.restore(&other.save()).unwrap_err();
    assert!(error.0.contains("-1"), "{error}");
    instance.step(0.5, 0.5).unwrap();
    assert_eq!(output(&mut instance), 12.0);
}

#[test]
fn a_step_that_leads_to_infinity_is_refused_and_the_instance_comes_back() {
    let mut instance = running(3.0);
    let before = instance.save();
    let mut bytes = instance.to_bytes(&before);
    bytes.truncate(bytes.len() - 8);
    // u and the state are finite, but 1.7e308 + 3 · 1e308 · 0.5 is not.
    for (number, value) in [(2, 1e308_f64), (6, 1.7e308)] {
        let place = 13 + 8 * number;
        bytes[place..place + 8].copy_from_slice(&value.to_le_bytes());
    }
    let state = instance.from_bytes(&summed(bytes)).expect("finite numbers");
    instance.restore(&state).unwrap();
    let error = instance.step(0.5, 0.5).unwrap_err().0;
    assert!(error.contains("output y is inf at t = 1 s"), "{error}");
    instance.restore(&before).unwrap();
    instance.step(0.5, 0.5).unwrap();
    assert_eq!(output(&mut instance), 12.0);
}
