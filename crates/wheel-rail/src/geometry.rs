//! The distance of a wheel and a rail over the outward displacement D, softened, as a table.
//!
//! ```text
//! gap(s) = Z_r(u) − Z_w(s),  u = u_taping + s + D          s along the wheel; wheel outwards by D, touching at gap = Δz
//! g(D)   = −ε ln ∫ exp(−gap/ε) ds,   p ∝ exp(−gap/ε)       soft minimum, ε about 20 µm: the width of a real patch
//! g′ = ∫ p Z_r′,   u_c = ∫ p u,   r − r0 = ∫ p Z_w,   B₂ = ∫ p (κ_w + κ_r), at least 0.5 1/m
//! ```
//!
//! Tread and flange are tabulated apart, split at a fixed s, so that both may carry at once. With the sum over fixed s, g′ is
//! the exact derivative of g, and cubics through g and g′ lose nothing: the normal force has a potential. g counts from the
//! tread's value at D = 0.

mod build;

#[cfg(test)]
mod tests;

pub use build::{Pairing, of_profiles};

/// The least B₂, 1/m: flatter pairs would make patches wider than profiles are.
pub const LEAST_CURVATURE: f64 = 0.5;

/// The two parts of a wheel's profile that may touch at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// The running surface.
    Tread,
    /// The flange with its root.
    Flange,
}

impl Region {
    /// Both, tread first.
    pub const ALL: [Self; 2] = [Self::Tread, Self::Flange];
}

/// One displacement of the table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Node {
    /// g, m.
    pub distance: f64,
    /// g′.
    pub slope: f64,
    /// u_c, outward place of the contact from the track's middle, m.
    pub across: f64,
    /// r − r0, m.
    pub radius_change: f64,
    /// B₂, 1/m.
    pub curvature: f64,
}

/// One region of the table.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// D of the first node, m.
    pub start: f64,
    /// Distance of the nodes in D, m.
    pub spacing: f64,
    /// The nodes; none for a region that cannot touch.
    pub nodes: Vec<Node>,
}

impl Part {
    /// Node before D and how far D lies behind it in parts of the spacing; outside the table the end interval goes on.
    #[must_use]
    pub fn place(&self, d: f64) -> (usize, f64) {
        let position = (d - self.start) / self.spacing;
        let last = self.nodes.len().saturating_sub(2) as f64;
        let i = position.floor().clamp(0.0, last);
        (i as usize, position - i)
    }

    /// First and last D, m.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        [self.start, self.start + self.spacing * self.nodes.len().saturating_sub(1) as f64]
    }

    fn linear(&self, d: f64, of: impl Fn(&Node) -> f64) -> f64 {
        let (i, x) = self.place(d);
        match self.nodes.get(i..i + 2) {
            Some([a, b]) => of(a) + x * (of(b) - of(a)),
            _ => 0.0,
        }
    }

    /// r − r0 at D, m.
    #[must_use]
    pub fn radius_change(&self, d: f64) -> f64 {
        self.linear(d, |node| node.radius_change)
    }

    /// u_c at D, m.
    #[must_use]
    pub fn across(&self, d: f64) -> f64 {
        self.linear(d, |node| node.across)
    }

    /// B₂ at D, 1/m.
    #[must_use]
    pub fn curvature(&self, d: f64) -> f64 {
        self.linear(d, |node| node.curvature)
    }

    /// g, g′ and g″ at D from the cubic through g and g′; in a straight line beyond the ends.
    #[must_use]
    pub fn distance(&self, d: f64) -> [f64; 3] {
        let (i, x) = self.place(d);
        match self.nodes.get(i..i + 2) {
            Some([a, b]) => cubic(x, self.spacing, [a.distance, a.slope], [b.distance, b.slope]),
            _ => [0.0; 3],
        }
    }
}

/// Value, slope and second derivative at the part `x` of an interval of length `h` between (value, slope) at its ends.
pub(crate) fn cubic(x: f64, h: f64, [a, m]: [f64; 2], [b, n]: [f64; 2]) -> [f64; 3] {
    if x < 0.0 {
        return [a + m * h * x, m, 0.0];
    }
    if x > 1.0 {
        return [b + n * h * (x - 1.0), n, 0.0];
    }
    // a + m h x + c x² + e x³
    let (rise, m, n) = (b - a, m * h, n * h);
    let c = 3.0 * rise - 2.0 * m - n;
    let e = m + n - 2.0 * rise;
    [a + x * (m + x * (c + x * e)), (m + x * (2.0 * c + 3.0 * x * e)) / h, (2.0 * c + 6.0 * x * e) / (h * h)]
}

/// The table of one wheel on one rail.
#[derive(Clone, Debug)]
pub struct Geometry {
    parts: [Part; 2],
    /// ε, m; 0 for a table that was not made from profiles.
    pub softness: f64,
}

impl Geometry {
    /// A wheel whose contact does not move: r − r0 = λ D at the outward place `across`, m, with the curvature B₂, 1/m.
    ///
    /// With `sloped` the surface has the cone's slope g′ = −λ; without it is level: Klingel's kinematic cone.
    #[must_use]
    pub fn cone(conicity: f64, across: f64, curvature: f64, sloped: bool) -> Self {
        const REACH: f64 = 0.05;
        let slope = if sloped { -conicity } else { 0.0 };
        let node = |d: f64| Node { distance: slope * d, slope, across, radius_change: conicity * d, curvature };
        let tread = Part { start: -REACH, spacing: REACH, nodes: vec![node(-REACH), node(0.0), node(REACH)] };
        Self { parts: [tread, Part::default()], softness: 0.0 }
    }

    /// One region.
    #[must_use]
    pub fn region(&self, region: Region) -> &Part {
        &self.parts[region as usize]
    }

    /// Least and largest D of the table, m: beyond it the wheel has left its rail.
    ///
    /// Outwards it ends where the top of the flange stands on the rail.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        let [tread, flange] = self.parts.each_ref().map(Part::extent);
        if self.parts[1].nodes.is_empty() { tread } else { [tread[0], tread[1].min(flange[1])] }
    }

    /// A number that two tables share only if they are the same (FNV-1a over all bits).
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let nodes = self.parts.iter().flat_map(|part| {
            let fields = |n: &Node| [n.distance, n.slope, n.across, n.radius_change, n.curvature];
            [part.start, part.spacing].into_iter().chain(part.nodes.iter().flat_map(fields))
        });
        let bytes = nodes.flat_map(|x| x.to_bits().to_le_bytes());
        bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }
}
