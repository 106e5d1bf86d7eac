//! Static equilibrium of a case, and the state it starts from.

use ttb_contract::Instance;
use ttb_scenario::spec::{BridgeSpec, TrainTrackSpec};
use ttb_train_track::TrainTrack;
use ttb_train_track::car::AXLES;

use crate::constant;
use crate::error::ReferenceError;
use crate::whole::{Whole, case};

impl Whole {
    /// Assembles a case and finds its static equilibrium; the cars are pre-rolled as in the product.
    ///
    /// # Errors
    /// Modal damping, matrices that cannot be factorised, data that a subsystem refuses.
    pub fn new(train: &TrainTrackSpec, spec: &BridgeSpec) -> Result<Self, ReferenceError> {
        let mut whole = Self::assemble(train, spec)?;
        whole.rest(train)?;
        Ok(whole)
    }

    /// Static equilibrium. Every axle carries its static load then, whatever the rail looks like: each car's ten equations
    /// leave no choice. The train–track subsystem of the product adds the cars' state, pre-roll included.
    fn rest(&mut self, train: &TrainTrackSpec) -> Result<(), ReferenceError> {
        self.wheels.place(&self.track, 0.0).map_err(case)?;
        let n = self.track.order();
        let pencil = constant::equations(self, 0.0, 0.0).finish_with(&self.layout).map_err(case)?;
        if let Some(order) = pencil.order() {
            self.layout.order = order.to_vec();
        }
        let factor = pencil.factor(1.0, 0.0, 0.0).map_err(case)?;
        drop(pencil);
        let mut u = vec![0.0; self.order()];
        let loads = self.cars.iter().flat_map(|car| [car.axle_load; AXLES]);
        for (point, load) in self.wheels.points.iter().zip(loads) {
            self.track.add_force(point, load, &mut u[..n]);
        }
        factor.solve_in_place(&mut u, &mut vec![0.0; self.order()]);
        let mut motion = self.deck(&u[n..]);
        motion.resize(2 * motion.len(), 0.0);
        let mut instance = Instance::new(TrainTrack::new(train.clone()).map_err(case)?);
        let inputs: Vec<u32> = (0..motion.len() as u32).collect();
        instance.enter_initialization(0.0).map_err(case)?;
        instance.set(&inputs, &motion).map_err(case)?;
        instance.exit_initialization().map_err(case)?;
        let state = ttb_contract::Model::save(instance.model()).plane();
        let state = state.ok_or_else(|| case("the paper's other methods know plane runs only".to_string()))?;
        self.start.track = state.track.clone();
        self.start.cars = state.cars.clone();
        self.start.bridge.u = u.split_off(n);
        self.start.forces.clone_from(&state.forces);
        for (axle, approach) in self.start.approach.iter_mut().enumerate() {
            *approach = state.delta[axle] + self.wheels.points[axle].local_compliance * state.forces[axle];
        }
        Ok(())
    }
}
