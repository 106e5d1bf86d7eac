//! What a report is made of.

use ttb_assessment::{Results, Verdicts};

/// Everything, as values.
pub struct Input<'a> {
    /// Title of the scenario.
    pub title: String,
    /// Free fields for people: project, author, checker; name and text.
    pub people: Vec<[String; 2]>,
    /// Version of the program.
    pub version: String,
    /// The date; the only thing that differs between two reports of the same results.
    pub date: String,
    /// Hash of what the scenario means.
    pub hash: Option<String>,
    /// What the criteria say.
    pub verdicts: &'a Verdicts,
    /// Runs and rows.
    pub results: &'a Results,
    /// The bridge, as far as it is known.
    pub bridge: Option<Bridge>,
    /// FMUs that were given in the place of the bridge, and their maps.
    pub given: Vec<Property>,
    /// Trains of axle loads.
    pub trains: Vec<Train>,
    /// Extremes along the deck of some runs.
    pub envelopes: Vec<Envelope>,
    /// Histories of governing runs.
    pub passages: Vec<Passage>,
    /// How the governing value changes with what was chosen.
    pub changes: Vec<Change>,
    /// What can be done for more of these lines; empty: nothing.
    pub more_changes: String,
    /// Losses of contact of one run.
    pub losses: Option<Losses>,
    /// Comfort with and without the bridge.
    pub comfort: Vec<Comfort>,
    /// Commands that make all this again.
    pub commands: Vec<String>,
    /// Files of the folder: name, and what it holds or its hash.
    pub files: Vec<[String; 2]>,
    /// Warnings that were given.
    pub warnings: Vec<String>,
}

/// The bridge.
#[derive(Clone, Debug, Default)]
pub struct Bridge {
    /// Length of the deck, m.
    pub length: f64,
    /// Bearings from its begin, m; both ends are among them.
    pub bearings: Vec<f64>,
    /// Points: name and abscissa, m.
    pub points: Vec<(String, f64)>,
    /// What was given.
    pub properties: Vec<Property>,
    /// Natural modes.
    pub modes: Vec<ModeShape>,
}

/// A value of the input.
#[derive(Clone, Debug)]
pub struct Property {
    /// What.
    pub name: String,
    /// As text, with digits that are known.
    pub value: String,
    /// Unit.
    pub unit: String,
    /// Where it comes from.
    pub source: String,
}

/// A natural mode.
#[derive(Clone, Debug)]
pub struct ModeShape {
    /// Hz.
    pub frequency: f64,
    /// Damping ratio, where it is known.
    pub damping: Option<f64>,
    /// Abscissa, m, and vertical motion of the deck; empty where it is not known.
    pub shape: Vec<[f64; 2]>,
}

/// A train of axle loads.
#[derive(Clone, Debug)]
pub struct Train {
    /// Its name in tables.
    pub name: String,
    /// Distance behind the first axle, m, and load, N.
    pub axles: Vec<[f64; 2]>,
    /// Wavelength, m, and amplitude G, N.
    pub signature: Vec<[f64; 2]>,
    /// Wavelengths of its repeating distances, m, the strongest first.
    pub spacings: Vec<f64>,
    /// Where its first axle is at time 0, m from the begin of the bridge.
    pub starts_at: f64,
    /// Where the data come from.
    pub source: String,
}

/// Extremes along the deck.
#[derive(Clone, Debug)]
pub struct Envelope {
    /// Run.
    pub run_id: String,
    /// Quantity.
    pub quantity: String,
    /// Label of the filter.
    pub filter: String,
    /// Abscissas, m.
    pub x: Vec<f64>,
    /// Least values.
    pub min: Vec<f64>,
    /// Greatest values.
    pub max: Vec<f64>,
}

/// A history, raw and filtered.
#[derive(Clone, Debug)]
pub struct History {
    /// What and where.
    pub title: String,
    /// SI unit.
    pub unit: String,
    /// Time, s, equal steps.
    pub time: Vec<f64>,
    /// As it was computed.
    pub raw: Vec<f64>,
    /// Behind the criterion's filter; empty without one.
    pub filtered: Vec<f64>,
    /// Label of the filter.
    pub filter: String,
    /// Its cut-off, Hz.
    pub cut_off: Option<f64>,
}

/// The deck's acceleration over place and time.
#[derive(Clone, Debug)]
pub struct SpaceTime {
    /// Abscissas, m.
    pub x: Vec<f64>,
    /// Times, s.
    pub time: Vec<f64>,
    /// One row a time, m/s².
    pub values: Vec<Vec<f64>>,
    /// Paths of axles: time and abscissa when an axle comes and when it leaves, m from the deck's begin.
    pub paths: Vec<[[f64; 2]; 2]>,
}

/// A governing passage.
#[derive(Clone, Debug)]
pub struct Passage {
    /// Run.
    pub run_id: String,
    /// Which criterion it governs, train and speed.
    pub title: String,
    /// Histories.
    pub histories: Vec<History>,
    /// The deck over place and time.
    pub space_time: Option<SpaceTime>,
}

/// How the governing value changes.
#[derive(Clone, Debug)]
pub struct Change {
    /// What was changed.
    pub what: String,
    /// The value of before.
    pub before: f64,
    /// The value then.
    pub after: f64,
    /// Unit of both.
    pub unit: String,
}

/// Losses of contact of one run over the way.
#[derive(Clone, Debug)]
pub struct Losses {
    /// Run.
    pub run_id: String,
    /// The train and its speed.
    pub title: String,
    /// Where each begins on the track, m, and how long it lasts, s.
    pub bars: Vec<[f64; 2]>,
    /// Where the bridge begins and ends on the track, m.
    pub bridge: Option<[f64; 2]>,
}

/// A value of a car body over the bridge, and of the same train on the same rail over a deck that does not move.
#[derive(Clone, Debug)]
pub struct Comfort {
    /// Quantity, car and place in it.
    pub what: String,
    /// Label of the filter, and the statistic.
    pub how: String,
    /// Unit.
    pub unit: String,
    /// Over the bridge.
    pub with: f64,
    /// Over the deck that does not move.
    pub without: f64,
}
