//! The model: a sketch to scale with the governing train, inputs, frequencies; and the trains.

use serde::Serialize;

use super::{Figure, Table};
use crate::chart::{Band, Chart, Curve, Line, escape};
use crate::input::{Bridge, Input, Train};
use crate::number::{digits, short};

#[derive(Serialize)]
pub(crate) struct Model {
    sketch: String,
    caption: String,
    inputs: Table,
    modes: Table,
    line: Option<Figure>,
    shapes: Option<Figure>,
}

/// Points that are named in the sketch at most.
const NAMED: usize = 8;
/// Trains that are drawn at most.
const DRAWN: usize = 24;

impl Model {
    pub fn new(input: &Input) -> Self {
        let mut inputs = Table::new(&["input", "value", "unit", "source"]);
        let mut modes = Table::new(&["mode", "frequency, Hz", "damping, %"]);
        let (mut sketched, mut caption, mut figure) = (String::new(), String::new(), None);
        if let Some(bridge) = &input.bridge {
            let governing = governing(input);
            (sketched, caption) = sketch(bridge, governing);
            for (i, mode) in bridge.modes.iter().enumerate() {
                let damping = mode.damping.map_or_else(|| "–".into(), |ratio| digits(100.0 * ratio, 3));
                modes.rows.push(vec![(i + 1).to_string(), digits(mode.frequency, 5), damping]);
            }
            figure = shapes(bridge);
        }
        let of_bridge = input.bridge.iter().flat_map(|bridge| &bridge.properties);
        for p in input.given.iter().chain(of_bridge) {
            inputs.rows.push(vec![p.name.clone(), p.value.clone(), p.unit.clone(), p.source.clone()]);
        }
        let line = input.bridge.as_ref().and_then(|bridge| frequencies(bridge, input));
        Self { sketch: sketched, caption, inputs, modes, line, shapes: figure }
    }
}

/// The train of the worst verdict, and where its first axle stood.
fn governing<'a>(input: &'a Input) -> Option<(&'a Train, Option<f64>)> {
    let verdict = input.verdicts.verdicts.iter().find(|verdict| verdict.train.is_some())?;
    let train = input.trains.iter().find(|train| Some(&train.name) == verdict.train.as_ref())?;
    let first = verdict.time_s.zip(verdict.speed_km_h).map(|(t, v)| train.starts_at + t * v / 3.6);
    Some((train, first))
}

fn sketch(bridge: &Bridge, governing: Option<(&Train, Option<f64>)>) -> (String, String) {
    let (width, margin, deck) = (720.0, 30.0, 62.0);
    let scale = (width - 2.0 * margin) / bridge.length.max(1e-9);
    let at = |x: f64| margin + scale * x;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {width} 120\" class=\"chart sketch\" role=\"img\" aria-label=\"The bridge to scale, {} m\">",
        short(bridge.length)
    );
    svg += &format!(
        "<line class=\"deck\" x1=\"{:.1}\" y1=\"{deck}\" x2=\"{:.1}\" y2=\"{deck}\"/>",
        at(0.0),
        at(bridge.length)
    );
    for x in &bridge.bearings {
        let x = at(*x);
        svg += &format!("<path class=\"bearing\" d=\"M{x:.1},{deck} l-7,12 h14 z\"/>");
    }
    for (i, pair) in bridge.bearings.windows(2).enumerate() {
        let middle = at(0.5 * (pair[0] + pair[1]));
        if bridge.bearings.len() <= 13 || i % 5 == 0 {
            svg += &format!(
                "<text class=\"tick\" x=\"{middle:.1}\" y=\"92\" text-anchor=\"middle\">{} m</text>",
                short(pair[1] - pair[0])
            );
        }
    }
    for (i, (name, x)) in bridge.points.iter().enumerate() {
        let place = at(*x);
        let title = escape(&format!("{name}: x = {} m", short(*x)));
        svg += &format!(
            "<circle class=\"dot c2\" cx=\"{place:.1}\" cy=\"{deck}\" r=\"3\"><title>{title}</title></circle>"
        );
        if i < NAMED {
            svg += &format!(
                "<text class=\"mark\" x=\"{place:.1}\" y=\"108\" text-anchor=\"middle\">{}</text>",
                escape(name)
            );
        }
    }
    let mut caption = "To scale along the track; dots are points.".to_string();
    if let Some((train, first)) = governing {
        let length = train.axles.last().map_or(0.0, |axle| axle[0]);
        // Without a time the train stands in the middle.
        let front = first.unwrap_or(0.5 * (bridge.length + length));
        let most = train.axles.iter().map(|axle| axle[1]).fold(0.0, f64::max);
        let mut shown = 0;
        for [x, load] in &train.axles {
            let place = front - x;
            if (0.0..=bridge.length).contains(&place) {
                shown += 1;
                let (x, top) = (at(place), deck - 14.0 - 26.0 * load / most);
                svg += &format!(
                    "<line class=\"load\" x1=\"{x:.1}\" y1=\"{top:.1}\" x2=\"{x:.1}\" y2=\"{:.1}\"/><path class=\"tip\" d=\"M{x:.1},{:.1} l-2.5,-6 h5 z\"/>",
                    deck - 6.0,
                    deck - 3.0
                );
            }
        }
        caption += &format!(
            " {}, {shown} of {} axles on the bridge when the worst value occurs.",
            train.name,
            train.axles.len()
        );
    }
    (svg + "</svg>", caption)
}

/// The modes on an axis of frequencies, with n₀, the third mode and the cut-off of the deck's filter.
fn frequencies(bridge: &Bridge, input: &Input) -> Option<Figure> {
    let facts = &input.verdicts.facts;
    let line = |at: Option<f64>, name: &str, class| {
        at.map(|at| Line { at, name: format!("{name} {} Hz", digits(at, 4)), class })
    };
    let deck = input.verdicts.verdicts.iter().find(|verdict| verdict.criterion == "deck-acceleration");
    let cut_off =
        deck.and_then(|verdict| verdict.filter.split('-').find_map(|part| part.strip_suffix("Hz")?.parse().ok()));
    let marks = [
        line(facts.n0_hz, "n₀", "cancel"),
        line(facts.third_mode_hz, "third mode", "cancel"),
        line(cut_off, "cut-off f_c", "resonance"),
    ];
    let bars = bridge.modes.iter().map(|mode| ([mode.frequency, 100.0 * mode.damping.unwrap_or(0.01)], "stick c1"));
    let most = cut_off.into_iter().chain(facts.third_mode_hz).fold(0.0, f64::max);
    let chart = Chart {
        name: "Natural frequencies and the cut-off of the filter".into(),
        x_name: "frequency, Hz".into(),
        y_name: "damping, %".into(),
        bars: bars.collect(),
        bars_over: Some([0.0, 1.05 * most]),
        upright: marks.into_iter().flatten().collect(),
        height: 170.0,
        from_zero: true,
        ..Chart::default()
    };
    if chart.bars.is_empty() {
        return None;
    }
    let from = facts.modes_from.clone().unwrap_or_default();
    let note = format!("A bar a mode that loads on the deck excite. n₀ and third mode: {from}.");
    Some(Figure { title: "Frequencies and the cut-off".into(), svg: chart.svg(), note, table: Table::default() })
}

/// Axles of a train to scale, the heaviest load highest.
fn drawing(train: &Train, longest: f64) -> String {
    let (width, ground) = (720.0, 30.0);
    let most = train.axles.iter().map(|axle| axle[1]).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let at = |x: f64| width - 6.0 - x / longest.max(1e-9) * (width - 12.0);
    let name = escape(&format!("Axles of {} to scale", train.name));
    let mut svg = format!("<svg viewBox=\"0 0 {width} 34\" class=\"chart\" role=\"img\" aria-label=\"{name}\">");
    let rear = at(train.axles.last().map_or(0.0, |axle| axle[0]));
    svg += &format!(
        "<line class=\"axis\" x1=\"{rear:.1}\" y1=\"{ground}\" x2=\"{:.1}\" y2=\"{ground}\"/><path class=\"load\" d=\"",
        at(0.0)
    );
    for [x, load] in &train.axles {
        svg += &format!("M{:.1} {:.1}V{ground}", at(*x), ground - 24.0 * load / most);
    }
    svg + "\"/></svg>"
}

/// Shapes of the first modes.
fn shapes(bridge: &Bridge) -> Option<Figure> {
    let classes = ["c1 bold", "c2 dash bold", "c3 dot-line bold", "c4"];
    let drawn = bridge.modes.iter().filter(|mode| mode.shape.len() > 1).zip(classes);
    let curves: Vec<Curve> = drawn
        .enumerate()
        .map(|(i, (mode, class))| Curve {
            name: format!("mode {}, {} Hz", i + 1, digits(mode.frequency, 4)),
            class: class.into(),
            points: mode.shape.iter().map(|[x, y]| [*x, -y]).collect(),
            dots: Vec::new(),
        })
        .collect();
    if curves.is_empty() {
        return None;
    }
    let chart = Chart {
        name: "Shapes of the first modes along the deck".into(),
        x_name: "from the begin of the bridge, m".into(),
        y_name: "motion, up".into(),
        curves,
        height: 220.0,
        ..Chart::default()
    };
    let note = "Vertical motion of the deck, scaled to the modal mass.".into();
    Some(Figure { title: "Shapes of modes".into(), svg: chart.svg(), note, table: Table::default() })
}

/// Signatures of the trains, with the wavelengths v/n₀ of the runs.
pub(crate) fn trains(input: &Input) -> Vec<Figure> {
    let drawn: Vec<&Train> = input.trains.iter().filter(|train| train.signature.len() > 1).collect();
    let mut figures = Vec::new();
    if !drawn.is_empty() {
        let worst = input.verdicts.verdicts.iter().find_map(|verdict| verdict.train.clone());
        let speeds = || input.results.runs.iter().filter_map(|run| run.speed_km_h);
        let band = input.verdicts.facts.n0_hz.and_then(|f| {
            let range = [speeds().reduce(f64::min)? / 3.6 / f, speeds().reduce(f64::max)? / 3.6 / f];
            Some(Band { range, name: "v/n₀ of these runs".into() })
        });
        let curve = |train: &&Train| {
            let named = Some(&train.name) == worst.as_ref() || drawn.len() == 1;
            let class = if named { "c1 bold" } else { "grey" };
            Curve {
                name: if named { train.name.clone() } else { String::new() },
                class: class.into(),
                points: train.signature.iter().map(|[l, g]| [*l, g * 1e-3]).collect(),
                dots: Vec::new(),
            }
        };
        let mut curves: Vec<Curve> = drawn.iter().map(curve).collect();
        curves.sort_by_key(|curve| !curve.name.is_empty());
        let spacing =
            drawn.iter().find(|train| Some(&train.name) == worst.as_ref()).and_then(|train| train.spacings.first());
        let chart = Chart {
            name: "Signatures of the trains".into(),
            x_name: "wavelength λ = v/f, m".into(),
            y_name: "G, kN".into(),
            curves,
            bands: band.into_iter().collect(),
            upright: spacing
                .map(|d| Line { at: *d, name: format!("d = {} m", short(*d)), class: "resonance" })
                .into_iter()
                .collect(),
            from_zero: true,
            ..Chart::default()
        };
        let note =
            "Shaded: wavelengths v/n₀ of the speeds of these runs. A high G there means resonance of the first mode."
                .into();
        figures.push(Figure { title: "Signatures G(λ)".into(), svg: chart.svg(), note, table: Table::default() });
    }
    if !input.trains.is_empty() {
        let mut table =
            Table::new(&["train", "axles", "sum, kN", "first to last axle, m", "greatest load, kN", "source"]);
        for train in &input.trains {
            let sum: f64 = train.axles.iter().map(|axle| axle[1]).sum();
            let most = train.axles.iter().map(|axle| axle[1]).fold(0.0, f64::max);
            let length = train.axles.last().map_or(0.0, |axle| axle[0]);
            table.rows.push(vec![
                train.name.clone(),
                train.axles.len().to_string(),
                short(sum * 1e-3),
                short(length),
                short(most * 1e-3),
                train.source.clone(),
            ]);
        }
        let longest =
            input.trains.iter().filter_map(|train| train.axles.last()).map(|axle| axle[0]).fold(0.0, f64::max);
        let row = |train: &Train| format!("<p class=\"train\">{}</p>{}", escape(&train.name), drawing(train, longest));
        let drawn: String = input.trains.iter().take(DRAWN).map(row).collect();
        let note =
            format!("To scale, running to the right; the longest is {} m from first to last axle.", short(longest));
        figures.push(Figure { title: "Axles".into(), svg: drawn, note, table: Table::default() });
        figures.push(Figure { title: "Axles and loads".into(), svg: String::new(), note: String::new(), table });
    }
    figures
}
