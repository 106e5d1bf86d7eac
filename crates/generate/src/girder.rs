//! A girder of shells from one end to the other.

use crate::builder::Builder;
use crate::fit::Mesh;
use crate::lines::{SAME, count, divide, nearest, ordered};
use crate::trough::Trough;

/// Half the width of the strip of floor that carries the track and its dead load, m.
pub(crate) const STRIP: f64 = 2.2;

/// What a girder is.
pub(crate) struct Girder {
    /// Begins the names of its sections.
    pub(crate) prefix: String,
    /// Cross-section.
    pub(crate) trough: Trough,
    /// Overall height at abscissae, linear in between, m.
    pub(crate) heights: Vec<[f64; 2]>,
    /// Abscissae of the cross-beams, the ends among them, ascending.
    pub(crate) cross_beams: Vec<f64>,
    /// y of the track's axis, m.
    pub(crate) track: f64,
}

/// Where its nodes are.
pub(crate) struct Placed {
    x: Vec<f64>,
    y: Vec<f64>,
    cross_beams: Vec<f64>,
    /// Top of the left and right web by x.
    tops: [Vec<u32>; 2],
    /// Where left and right web meet the floor, by x.
    edges: [Vec<u32>; 2],
    /// Bottom of the cross-beams by y.
    bottoms: Vec<Vec<u32>>,
}

/// Left (y < 0) and right.
pub(crate) const SIDES: [usize; 2] = [0, 1];

impl Placed {
    /// Top of a web at abscissa `x`.
    pub(crate) fn top(&self, x: f64, side: usize) -> u32 {
        self.tops[side][nearest(&self.x, x)]
    }

    /// Where both webs meet the floor at abscissa `x`.
    pub(crate) fn edges(&self, x: f64) -> [u32; 2] {
        SIDES.map(|side| self.edges[side][nearest(&self.x, x)])
    }

    /// Bottom of the cross-beam at abscissa `x` under both webs.
    pub(crate) fn corners(&self, x: f64) -> [u32; 2] {
        let row = &self.bottoms[nearest(&self.cross_beams, x)];
        [row[0], row[row.len() - 1]]
    }

    /// Bottom of the cross-beam at abscissa `x` nearest to the axis, and its y.
    pub(crate) fn middle(&self, x: f64) -> (u32, f64) {
        let j = nearest(&self.y, 0.0);
        (self.bottoms[nearest(&self.cross_beams, x)][j], self.y[j])
    }
}

/// Numbers of elements up a web, over half a flange, down a cross-beam.
struct Divisions {
    web: usize,
    flange: usize,
    cross_beam: usize,
}

impl Girder {
    /// Overall height at abscissa `x`, m.
    pub(crate) fn height(&self, x: f64) -> f64 {
        let after = self.heights.partition_point(|point| point[0] <= x);
        match (after.checked_sub(1).map(|i| self.heights[i]), self.heights.get(after)) {
            (Some([x0, h0]), Some([x1, h1])) => h0 + (h1 - h0) * (x - x0) / (x1 - x0),
            (Some([_, h]), None) | (None, Some(&[_, h])) => h,
            (None, None) => 0.0,
        }
    }

    /// Names of the sections of the floor: under the track, beside it.
    pub(crate) fn floor(&self) -> [String; 2] {
        ["track", "edge"].map(|part| format!("{}-floor-{part}", self.prefix))
    }

    fn name(&self, part: &str) -> String {
        format!("{}-{part}", self.prefix)
    }

    /// Lines of the floor that the mesh must have: webs, axis, track's axis, edges of its strip.
    fn across(&self) -> Vec<f64> {
        let (b, track) = (self.trough.half_width, self.track);
        let mut breaks = vec![-b, track - STRIP, track, track + STRIP, b];
        if breaks.iter().all(|other| other.abs() > 0.5) {
            breaks.push(0.0); // nearer to another line it would make slivers
        }
        ordered(breaks)
    }

    fn divisions(&self, mesh: Mesh) -> Divisions {
        let rise = self.heights.iter().map(|point| self.trough.rise(point[1])).fold(0.0, f64::max);
        let parts = |length: f64, size: f64| count(&[0.0, length], size) - 1;
        Divisions {
            web: parts(rise, mesh.up),
            flange: parts(0.5 * self.trough.flange, mesh.across),
            cross_beam: parts(self.trough.cross_beam, mesh.up),
        }
    }

    /// Number of nodes on a mesh.
    pub(crate) fn nodes(&self, mesh: Mesh) -> usize {
        let across = count(&self.across(), mesh.across);
        let Divisions { web, flange, cross_beam } = self.divisions(mesh);
        count(&self.cross_beams, mesh.along) * (across + 2 * web + 4 * flange)
            + self.cross_beams.len() * cross_beam * across
    }

    /// Adds its sections; `load`: dead load that the track brings, kg/m.
    pub(crate) fn add_sections(&self, builder: &mut Builder, material: &str, load: f64) {
        let trough = &self.trough;
        let [track, edge] = self.floor();
        builder.shell_section(&track, material, trough.floor, load / (2.0 * STRIP));
        builder.shell_section(&edge, material, trough.floor, 0.0);
        builder.shell_section(&self.name("web"), material, trough.web, 0.0);
        builder.shell_section(&self.name("flange"), material, trough.flange_thickness, 0.0);
        builder.shell_section(&self.name("cross-beam"), material, trough.cross_beam_thickness, 0.0);
    }

    /// Adds its nodes and shells.
    pub(crate) fn add(&self, builder: &mut Builder, mesh: Mesh) -> Placed {
        let x = divide(&self.cross_beams, mesh.along);
        let y = divide(&self.across(), mesh.across);
        let divisions = self.divisions(mesh);
        // one column of nodes for each x: floor, then for each side the web upwards and the flange from left to right
        let columns: Vec<Column> = x.iter().map(|x| self.column(builder, *x, &y, &divisions)).collect();
        for pair in columns.windows(2) {
            self.floor_shells(builder, &y, &pair[0].floor, &pair[1].floor);
            for side in SIDES {
                strip(builder, &self.name("web"), &pair[0].webs[side], &pair[1].webs[side]);
                strip(builder, &self.name("flange"), &pair[0].flanges[side], &pair[1].flanges[side]);
            }
        }
        let bottoms = self.cross_beams.iter().map(|at| {
            let mut above = columns[nearest(&x, *at)].floor.clone();
            for k in 1..=divisions.cross_beam {
                let z = self.trough.cross_beam * k as f64 / divisions.cross_beam as f64;
                let below: Vec<u32> = y.iter().map(|y| builder.node([*at, *y, z])).collect();
                strip(builder, &self.name("cross-beam"), &above, &below);
                above = below;
            }
            above
        });
        let bottoms = bottoms.collect();
        let tops = SIDES.map(|side| columns.iter().map(|column| column.webs[side][divisions.web]).collect());
        let edges = SIDES.map(|side| columns.iter().map(|column| column.webs[side][0]).collect());
        Placed { x, y, cross_beams: self.cross_beams.clone(), tops, edges, bottoms }
    }

    fn column(&self, builder: &mut Builder, x: f64, y: &[f64], divisions: &Divisions) -> Column {
        let rise = self.trough.rise(self.height(x));
        let floor: Vec<u32> = y.iter().map(|y| builder.node([x, *y, 0.0])).collect();
        let mut webs = [vec![floor[0]], vec![floor[floor.len() - 1]]];
        let mut flanges = [Vec::new(), Vec::new()];
        for (side, sign) in SIDES.into_iter().zip([-1.0, 1.0]) {
            let b = sign * self.trough.half_width;
            for k in 1..=divisions.web {
                webs[side].push(builder.node([x, b, -rise * k as f64 / divisions.web as f64]));
            }
            let n = divisions.flange as isize;
            let step = 0.5 * self.trough.flange / n as f64;
            let top = webs[side][divisions.web];
            let node = |k| if k == 0 { top } else { builder.node([x, b + step * k as f64, -rise]) };
            flanges[side] = (-n..=n).map(node).collect();
        }
        Column { floor, webs, flanges }
    }

    fn floor_shells(&self, builder: &mut Builder, y: &[f64], back: &[u32], front: &[u32]) {
        let names = self.floor();
        for j in 0..y.len() - 1 {
            let middle = 0.5 * (y[j] + y[j + 1]);
            let under = (middle - self.track).abs() < STRIP - SAME;
            let name = if under { &names[0] } else { &names[1] };
            builder.shells(name, [[back[j], front[j], front[j + 1], back[j + 1]]]);
        }
    }
}

/// Nodes at one abscissa.
struct Column {
    floor: Vec<u32>,
    webs: [Vec<u32>; 2],
    flanges: [Vec<u32>; 2],
}

/// Shells between two rows of nodes.
fn strip(builder: &mut Builder, section: &str, back: &[u32], front: &[u32]) {
    let quads = back.windows(2).zip(front.windows(2)).map(|(a, b)| [a[0], b[0], b[1], a[1]]);
    builder.shells(section, quads);
}
