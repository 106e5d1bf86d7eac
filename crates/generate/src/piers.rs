//! Piers: a hollow column, a cap over it, bearings under the webs for the girders that end on them or run over them.

use ttb_scenario::types::{Bearings, Freedom};

use crate::builder::Builder;
use crate::girder::Placed;
use crate::lines::{divide, nearest};
use crate::plan;

/// Stiffness of a bearing, N/m: steel of 0.03 m² over 2.5 m.
const BEARING: f64 = 2.1e11 * 0.03 / 2.5;
/// Stiffness of a guide across, N/m.
const GUIDE: f64 = 1e9;

/// Sections of all piers.
pub(crate) fn add_sections(b: &mut Builder) {
    b.beam_section("pier-column", "C50", &plan::column());
    b.beam_section("pier-cap", "C50", &plan::cap());
}

/// A pier at `x` under `girders`. Its cap lies at the height of the bearings, whose own height is neglected: springs
/// then join nodes at one place and no moment is lost. Over the column the cap is rigid.
pub(crate) fn add(b: &mut Builder, x: f64, girders: &[&Placed]) {
    let Some(first) = girders.first() else { return };
    let (web, edge, top) = (plan::MAIN.half_width, plan::PIER, plan::MAIN.cross_beam);
    let guide = first.middle(x).1;
    let lines = divide(&[-web, -edge, guide, edge, web], plan::BEAM);
    let cap: Vec<u32> = lines.iter().map(|y| b.node([x, *y, top])).collect();
    b.beams("pier-cap", &cap);
    let at = |y: f64| cap[nearest(&lines, y)];
    let head = at(guide);
    b.rigid(head, vec![at(-edge), at(edge)]);
    let mut column = vec![head];
    let levels = divide(&[top, plan::FOOT], plan::BEAM);
    column.extend(levels.iter().skip(1).map(|z| b.node([x, guide, *z])));
    b.beams("pier-column", &column);
    b.model
        .bearings
        .push(Bearings { nodes: column.last().copied().into_iter().collect(), fixed: Freedom::ALL.to_vec() });
    for girder in girders {
        let corners = girder.corners(x);
        b.springs(&[[at(-web), corners[0]], [at(web), corners[1]]], [0.0, 0.0, BEARING, 0.0, 0.0, 0.0]);
        b.springs(&[[head, girder.middle(x).0]], [0.0, GUIDE, 0.0, 0.0, 0.0, 0.0]);
    }
}
