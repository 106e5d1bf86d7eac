//! Losses of contact over the way: of a run from its assessment, of a sweep from the history of its governing run.

use ttb_assessment::index::losses;
use ttb_assessment::peak::quantity::CONTACT_LOSS;
use ttb_assessment::{Run, Statistic};
use ttb_campaign::history::History;
use ttb_report::Losses;
use ttb_scenario::deck::Deck;

use crate::folder::Opened;

/// Losses of the run with the longest one, where they are known.
pub fn of(opened: &Opened) -> Option<Losses> {
    let longest = opened
        .results
        .rows
        .iter()
        .filter(|(_, peak)| peak.quantity == CONTACT_LOSS && peak.statistic == Statistic::Max);
    let (at, _) = longest.reduce(|worst, one| if one.1.value > worst.1.value { one } else { worst })?;
    let run = &opened.results.runs[*at];
    let bars = if opened.plan.is_some() { kept(opened, run)? } else { own(opened) };
    let bridge = opened.checked.as_ref().and_then(|checked| {
        let (at, deck) = (checked.scenario.bridge.at, Deck::new(&checked.bridge.structure)?);
        Some([at, at + deck.length])
    });
    let speed = run.speed_km_h.map_or_else(String::new, |v| format!(" at {} km/h", ttb_report::number::short(v)));
    Some(Losses { run_id: run.run_id.clone(), title: format!("{}{speed}", run.train), bars, bridge })
}

fn own(opened: &Opened) -> Vec<[f64; 2]> {
    opened.assessment.losses.iter().filter_map(|loss| Some([loss.x_m?[0], loss.seconds])).collect()
}

/// From the contact forces and positions of a history that was kept.
fn kept(opened: &Opened, run: &Run) -> Option<Vec<[f64; 2]>> {
    let history = History::parse(opened.files.open(&format!("history/{}.csv", run.run_id)).ok()??).ok()?;
    let rate = match history.time[..] {
        [first, .., last] => (history.time.len() - 1) as f64 / (last - first),
        _ => return None,
    };
    let values = |name: &str| history.columns().find(|(column, _, _)| *column == name).map(|(_, _, values)| values);
    let mut bars = Vec::new();
    for axle in 1.. {
        let force = values(&format!("wheel[{axle}].contact_force"));
        let (Some(force), Some(x)) = (force, values(&format!("wheel[{axle}].position"))) else { break };
        bars.extend(losses(force).iter().filter_map(|loss| Some([*x.get(loss.first)?, loss.seconds(rate)])));
    }
    Some(bars)
}
