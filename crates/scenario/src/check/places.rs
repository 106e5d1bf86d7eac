//! Where the rail lies and where the train goes: what the rules between both speak of.

/// The rail as laid.
pub(super) struct Rail {
    /// Abscissa of the first support, m.
    pub from: f64,
    /// Abscissa of the last support, m.
    pub to: f64,
    /// Bays between them.
    pub bays: usize,
    /// Distance of the supports, m.
    pub spacing: f64,
    /// Length of an element, m.
    pub element: f64,
}

/// The train's passage.
pub(super) struct Passage {
    /// Last wheel at the start, m.
    pub rear: f64,
    /// Leading wheel at the start, m.
    pub front: f64,
    /// Leading wheel at the end, m.
    pub end: f64,
    /// Pre-roll, m.
    pub pre_roll: f64,
    /// Length of all cars, m.
    pub length: f64,
    /// Whether the scenario says where the train starts, and when it ends.
    pub start_given: bool,
    pub end_given: bool,
}

impl Passage {
    /// Where a random irregularity without ramp begins to grow, m.
    pub fn fade_in(&self) -> f64 {
        crate::travel::fade_in(self.front, self.front - self.rear, self.length, self.pre_roll)
    }
}
