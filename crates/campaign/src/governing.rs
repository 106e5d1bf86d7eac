//! The runs with the largest deck acceleration and the largest deflection, and what the coupled way says of them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::plan::{Plan, Run};
use crate::record::{Record, Records};
use crate::refine::Key;

/// Name of the file with the comparison.
pub const FILE: &str = "coupled-check.json";

/// Largest relative difference of the ways that is allowed: of accelerations, of displacements.
pub const ALLOWED: [f64; 2] = [0.03, 0.01];

/// The run in which a quantity is largest.
#[derive(Clone, Debug, PartialEq)]
pub struct Governing {
    /// Quantity and filter.
    pub key: Key,
    /// The run.
    pub run: Run,
    /// Its amount.
    pub value: f64,
    /// Step of the run, s.
    pub step: Option<f64>,
}

/// Of every quantity the run in which it is largest; the first of equal ones.
///
/// # Errors
/// A record cannot be read.
pub fn of(runs: &[Run], keys: &[Key], records: &dyn Records) -> Result<Vec<Governing>, Error> {
    let mut best: Vec<Option<Governing>> = vec![None; keys.len()];
    for run in runs {
        let Some(record) = records.of(&run.id)? else { continue };
        for (key, best) in keys.iter().zip(&mut best) {
            let Some(value) = record.amount(&key.0, &key.1) else { continue };
            if best.as_ref().is_none_or(|best| value > best.value) {
                *best = Some(Governing { key: key.clone(), run: run.clone(), value, step: record.step });
            }
        }
    }
    Ok(best.into_iter().flatten().collect())
}

/// One quantity by both ways.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    /// Run.
    pub run_id: String,
    /// Train.
    pub train: String,
    /// km/h.
    pub speed_km_h: Option<f64>,
    /// Variant.
    pub variant: String,
    /// Quantity, the largest along the deck.
    pub quantity: String,
    /// Behind which filter.
    pub filter: String,
    /// By the way of the sweep.
    pub sweep: f64,
    /// By the coupled way with loads on a rigid track.
    pub coupled: f64,
    /// coupled/sweep − 1.
    pub difference: f64,
    /// Largest difference that is allowed.
    pub allowed: f64,
}

/// Compares all governing runs with their repetitions, as far as there are any, by the ids of the runs.
pub fn all_compared(plan: &Plan, governing: &[Governing], again: &BTreeMap<String, Record>) -> Vec<Compared> {
    let one = |one: &Governing| {
        let names = [&plan.trains[one.run.train].name, &plan.variants[one.run.variant].name];
        compared(one, again.get(&one.run.id)?, names.map(String::as_str))
    };
    governing.iter().filter_map(one).collect()
}

/// Compares a governing run with its repetition.
fn compared(governing: &Governing, again: &Record, [train, variant]: [&str; 2]) -> Option<Compared> {
    let (quantity, filter) = &governing.key;
    let coupled = again.amount(quantity, filter)?;
    let allowed = ALLOWED[usize::from(!quantity.ends_with("acceleration"))];
    Some(Compared {
        run_id: governing.run.id.clone(),
        train: train.into(),
        speed_km_h: governing.run.speed_km_h,
        variant: variant.into(),
        quantity: quantity.clone(),
        filter: filter.clone(),
        sweep: governing.value,
        coupled,
        difference: coupled / governing.value - 1.0,
        allowed,
    })
}
