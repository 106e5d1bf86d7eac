//! Piers: a column under each web, a beam over both, bearings for the girders that end on them or run over them.

use ttb_scenario::types::{Bearings, Freedom};

use crate::builder::Builder;
use crate::girder::{Placed, SIDES};
use crate::lines::divide;
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
/// then join nodes at one place and no moment is lost.
pub(crate) fn add(b: &mut Builder, x: f64, girders: &[&Placed]) {
    let Some(first) = girders.first() else { return };
    let (half, top) = (plan::MAIN.half_width, plan::MAIN.cross_beam);
    let guide = first.middle(x).1;
    let lines = divide(&[-half, guide, half], plan::BEAM);
    let cap: Vec<u32> = lines.iter().map(|y| b.node([x, *y, top])).collect();
    b.beams("pier-cap", &cap);
    let (ends, middle) = ([cap[0], cap[cap.len() - 1]], cap[crate::lines::nearest(&lines, guide)]);
    let mut feet = Vec::new();
    for (side, sign) in SIDES.into_iter().zip([-1.0, 1.0]) {
        let mut column = vec![ends[side]];
        let levels = divide(&[top, plan::FOOT], plan::BEAM);
        column.extend(levels.iter().skip(1).map(|z| b.node([x, sign * half, *z])));
        b.beams("pier-column", &column);
        feet.extend(column.last());
        let bearings: Vec<[u32; 2]> = girders.iter().map(|girder| [ends[side], girder.corners(x)[side]]).collect();
        b.springs(&bearings, [0.0, 0.0, BEARING, 0.0, 0.0, 0.0]);
    }
    let guides: Vec<[u32; 2]> = girders.iter().map(|girder| [middle, girder.middle(x).0]).collect();
    b.springs(&guides, [0.0, GUIDE, 0.0, 0.0, 0.0, 0.0]);
    b.model.bearings.push(Bearings { nodes: feet, fixed: Freedom::ALL.to_vec() });
}
