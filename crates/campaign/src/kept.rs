//! Which histories of a run are kept: those of the scenario's points and bearings, and of the deck those of the point that moves
//! most and of the point that is accelerated most.

use std::path::Path;

use ttb_passage::{Output, PlaceKind, Quantity};

use crate::clock::Since;
use crate::compute::Computed;
use crate::history::History;
use crate::plan::Run;
use crate::record::Record;

/// A quantity and a place of the deck or of a name.
fn name(output: &Output) -> String {
    let quantity = output.quantity.name().rsplit('.').next().unwrap_or_default();
    match (output.place.kind, output.place.x) {
        (PlaceKind::Deck, Some(x)) => format!("deck[{x}].{quantity}"),
        (kind, _) => format!("{}[{}].{quantity}", kind.name(), output.place.name),
    }
}

/// Of outputs sampled every `h` seconds from a bridge at rest; `of` gives the history of the output with a number.
pub fn of_outputs(outputs: &[Output], h: f64, of: &dyn Fn(usize) -> Vec<f64>) -> History {
    let mut kept: Vec<(usize, Vec<f64>)> = Vec::new();
    for quantity in [Quantity::Acceleration, Quantity::Displacement] {
        let largest = |history: &[f64]| history.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let deck = (0..outputs.len())
            .filter(|k| outputs[*k].place.kind == PlaceKind::Deck && outputs[*k].quantity == quantity)
            .map(|k| (k, of(k)));
        kept.extend(deck.max_by(|a, b| largest(&a.1).total_cmp(&largest(&b.1))));
    }
    let named = (0..outputs.len()).filter(|k| outputs[*k].place.kind != PlaceKind::Deck).map(|k| (k, of(k)));
    kept.extend(named);
    let samples = kept.first().map_or(0, |(_, history)| history.len());
    let column = |(k, history): (usize, Vec<f64>)| (name(&outputs[k]), outputs[k].quantity.unit().into(), history);
    History { time: (0..samples).map(|n| n as f64 * h).collect(), values: kept.into_iter().map(column).collect() }
}

/// A finished run whose history is written into the campaign's folder, if there is one to write into. A run whose history
/// cannot be written has failed.
pub fn done(record: Record, folder: Option<&Path>, history: impl FnOnce() -> History) -> Computed {
    let written = folder.map_or(Ok(()), |folder| history().write(folder, &record.run_id));
    Computed::Done(match written {
        Ok(()) => record,
        Err(error) => Record::failed(&record.run_id, error.to_string(), record.seconds),
    })
}

/// A run that leaves a record and a history, or nothing because it was asked to stop, or why it failed.
pub fn ended(
    run: &Run,
    folder: Option<&Path>,
    work: impl FnOnce() -> Result<Option<(Record, History)>, String>,
) -> Computed {
    let begin = Since::now();
    match work() {
        Ok(Some((record, history))) => done(record, folder, || history),
        Ok(None) => Computed::Stopped,
        Err(error) => Computed::Done(Record::failed(&run.id, error, begin.seconds())),
    }
}
