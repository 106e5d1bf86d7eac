//! Serialized states of both models: whatever the bytes, the instance answers afterwards as before.

use std::cell::RefCell;
use std::path::Path;

use ttb_bridge::Bridge;
use ttb_contract::bytes::sum;
use ttb_contract::{Instance, Model, Snapshot};
use ttb_train_track::TrainTrack;

const SCENARIO: &str = r#"{"train":{"cars":["ice3-trailer"],"front_wheel":24.0,"speed":{"m_s":70}},
    "track":{"type":"slab","bays":50},
    "bridge":{"at":6.0,"structure":{"type":"beams","spans":[{"length":6,"bending_stiffness":4e9,"mass":9000,"elements":4}]},
    "damping":{"type":"none"}},"time":{"step":1e-3,"end":0.01}}"#;
/// Macro step, s.
const STEP: f64 = 1e-3;

/// An instance after one step, that moment as bytes, and the outputs after a second step.
struct Subject<M: Model> {
    instance: Instance<M>,
    good: Vec<u8>,
    snapshot: Snapshot<M>,
    outputs: Vec<u32>,
    then: Vec<f64>,
}

impl<M: Model> Subject<M> {
    fn new(model: M) -> Option<Self> {
        let outputs: Vec<u32> = model.interface().outputs().map(|reference| reference as u32).collect();
        let mut instance = Instance::new(model);
        instance.enter_initialization(0.0).ok()?;
        instance.exit_initialization().ok()?;
        instance.step(0.0, STEP).ok()?;
        let snapshot = instance.save();
        let good = instance.to_bytes(&snapshot);
        let mut then = vec![0.0; outputs.len()];
        instance.step(STEP, STEP).ok()?;
        instance.get(&outputs, &mut then).ok()?;
        Some(Self { instance, good, snapshot, outputs, then })
    }

    /// Reads a state, lives with it for a step if it is accepted, and goes back.
    fn try_one(&mut self, bytes: &[u8], same: bool) {
        let mut values = vec![0.0; self.outputs.len()];
        if let Ok(state) = self.instance.from_bytes(bytes) {
            assert!(same || bytes == self.good, "bytes with another sum were accepted");
            if self.instance.restore(&state).is_ok() {
                let stepped =
                    self.instance.step(STEP, STEP).and_then(|()| self.instance.get(&self.outputs, &mut values));
                assert!(
                    stepped.is_err() || values.iter().all(|x| x.is_finite()),
                    "a number that is not finite, unsaid"
                );
                let again = self.instance.save();
                let _ = self.instance.to_bytes(&again);
            }
        }
        let back = self.instance.restore(&self.snapshot).and_then(|()| self.instance.step(STEP, STEP));
        let back = back.and_then(|()| self.instance.get(&self.outputs, &mut values));
        assert!(back.is_ok(), "the instance does not go back to a good state: {back:?}");
        let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&values), bits(&self.then), "a state that was refused or left again stays in force");
    }
}

struct Both {
    bridge: Subject<Bridge>,
    train_track: Subject<TrainTrack>,
}

impl Both {
    fn new() -> Option<Self> {
        let checked = crate::models::checked(SCENARIO, Path::new(""))?;
        let bridge = Subject::new(Bridge::new(checked.bridge).ok()?)?;
        let train_track = Subject::new(TrainTrack::new(checked.train_track).ok()?)?;
        Some(Self { bridge, train_track })
    }
}

thread_local! {
    static BOTH: RefCell<Option<Both>> = RefCell::new(Both::new());
}

/// First byte: bit 0 whose state, bit 1 raw bytes instead of patches of a good state, bit 2 the end is cut off, bit 3 the
/// sum is made to fit, so that what stands behind it is reached. A patch is a place (two bytes) and a byte, or with bit 4
/// a place and eight bytes.
pub fn states(bytes: &[u8]) {
    let Some((how, rest)) = bytes.split_first() else { return };
    BOTH.with_borrow_mut(|both| {
        let Some(both) = both.as_mut() else { panic!("the models of this target cannot be made") };
        let mended = how & 8 != 0;
        if how & 1 == 0 {
            let state = patched(*how, rest, &both.bridge.good);
            both.bridge.try_one(&state, mended);
        } else {
            let state = patched(*how, rest, &both.train_track.good);
            both.train_track.try_one(&state, mended);
        }
    });
}

fn patched(how: u8, patches: &[u8], good: &[u8]) -> Vec<u8> {
    let mut state = if how & 2 == 0 { good.to_vec() } else { patches.to_vec() };
    if how & 2 == 0 {
        let length = if how & 16 == 0 { 1 } else { 8 };
        for patch in patches.chunks_exact(2 + length) {
            let at = usize::from(u16::from_le_bytes([patch[0], patch[1]])) % (state.len() - length);
            state[at..at + length].copy_from_slice(&patch[2..]);
        }
    }
    if how & 4 != 0 {
        state.truncate(state.len().saturating_sub(usize::from(how >> 5) * 8 + 1));
    }
    if how & 8 != 0
        && let Some(body) = state.len().checked_sub(8)
    {
        let sum = sum(&state[..body]);
        state[body..].copy_from_slice(&sum.to_le_bytes());
    }
    state
}
