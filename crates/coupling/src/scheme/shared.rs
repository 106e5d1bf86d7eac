//! What all ways of taking a step work on: the iteration, the account of work, the report.

use ttb_contract::Ports;

use crate::error::IterationError;
use crate::probe::{Strength, contraction};
use crate::report::Report;
use crate::scheme::account::Account;
use crate::scheme::audit::Audit;
use crate::scheme::step::Iteration;
use crate::settings::Settings;
use crate::trial::Sides;
use crate::work::Work;

pub(crate) struct Shared {
    pub iteration: Iteration,
    pub account: Account,
    pub audit: Audit,
    pub report: Report,
}

impl Shared {
    pub fn new(ports: Ports, settings: Settings) -> Self {
        let account = Account::new(&ports, settings.mean_forces);
        let audit = Audit::new(ports.forces(), ports.motions());
        Self { iteration: Iteration::new(ports, settings), account, audit, report: Report::default() }
    }

    /// ρ and α of the step from the saved states.
    pub fn contraction(&mut self, sides: &mut Sides) -> Result<Strength, IterationError> {
        let strength = contraction(&mut self.iteration.trials, sides)?;
        self.report.identification_trials += strength.trials;
        Ok(strength)
    }

    /// Accepts the trial: its work is counted, the next step begins there. With `answer` the train–track side's answer is
    /// carried on instead of the trial forces.
    pub fn accept(&mut self, sides: &mut Sides, answer: bool) -> Result<Work, IterationError> {
        let trials = &mut self.iteration.trials;
        let work = self.account.count(trials, sides)?;
        let (_, motion) = trials.exchange.parts();
        let amount = |most: f64, values: &[f64]| values.iter().fold(most, |most, x| most.max(x.abs()));
        let [force, position] = self.report.largest;
        self.report.largest = [amount(force, &trials.lambda), amount(position, motion.positions)];
        trials.accept(sides.h, answer);
        self.report.work += work;
        Ok(work)
    }

    /// Notes the method that is in force from `t` on.
    pub fn note(&mut self, t: f64) {
        self.report.switches.push((t, self.iteration.strategy.method()));
    }
}
