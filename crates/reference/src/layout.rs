//! In which order the unknowns of track and bridge are eliminated.

use ttb_bridge::assembled::Assembled;
use ttb_bridge::deck::Row;
use ttb_scenario::spec::TrainTrackSpec;
use ttb_sparse::Layout;
use ttb_train_track::track::Track;

/// Nodes, their places and what to eliminate last, the rail: the sweeps of a trial then stay short.
pub fn layout(train: &TrainTrackSpec, track: &Track, bridge: &Assembled) -> Layout {
    let n = track.order() as u32;
    let bays = train.bays + 1;
    let stride = (track.order() - 1) / train.bays.max(1);
    let bridge_nodes = bridge.node_of.iter().max().map_or(0, |node| node + 1).max(bridge.nodes.len() as u32);
    let bay_of = |dof: u32| (dof as usize / stride.max(1)).min(bays - 1) as u32;
    let node_of = (0..n).map(|dof| bridge_nodes + bay_of(dof)).chain(bridge.node_of.iter().copied()).collect();
    let last = (0..track.nodes()).flat_map(|node| [track.node_dof(node), track.node_dof(node) + 1]);
    let mut place = bridge.nodes.clone();
    let under =
        |row: &Row| row.first().and_then(|(dof, _)| bridge.nodes.get(*bridge.node_of.get(*dof as usize)? as usize));
    let known: Option<Vec<[f64; 3]>> = bridge.supports.iter().map(|row| under(row).copied()).collect();
    if let (Some(known), [first, .., last]) = (known.filter(|known| known.len() > 1), &train.on_bridge[..]) {
        // Off the bridge the track goes on as straight as it lies on it.
        let (a, b) = (known[0], known[known.len() - 1]);
        let along: [f64; 3] = std::array::from_fn(|i| (b[i] - a[i]) / (*last as f64 - *first as f64));
        place.extend((0..bays).map(|bay| {
            let nearest = (0..known.len()).min_by_key(|at| train.on_bridge[*at].abs_diff(bay));
            let at = nearest.unwrap_or_default();
            let ahead = bay as f64 - train.on_bridge[at] as f64;
            std::array::from_fn(|i| known[at][i] + ahead * along[i])
        }));
    } else {
        place.clear();
    }
    // A light bridge costs nothing, and the rail left for last would fill.
    let last = if bridge.equations.ndof() > track.order() { last.map(|dof| dof as u32).collect() } else { Vec::new() };
    Layout { node_of, place, last, order: Vec::new() }
}
