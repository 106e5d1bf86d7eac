//! Governing passages: histories raw and filtered, spectrum with the cut-off, the deck over place and time.
//!
//! ```text
//! amplitude of line i    A_i = 2/N |Σ_k a_k e^{−2πi ik/N}|,  up to 1.5 f_c or 60 Hz; every line of 1/T
//! ```

use std::f64::consts::PI;

use serde::Serialize;

use super::Figure;
use crate::chart::{Cells, Chart, Curve, Line, cells, thin};
use crate::input::{History, Input, SpaceTime};
use crate::number::readable;

/// Lines of a spectrum at most.
const LINES: usize = 400;

#[derive(Serialize)]
pub(crate) struct Passage {
    title: String,
    run_id: String,
    figures: Vec<Figure>,
}

pub(crate) fn all(input: &Input) -> Vec<Passage> {
    let of = |passage: &crate::input::Passage| {
        let histories = passage
            .histories
            .iter()
            .flat_map(|history| [Some(over_time(history)), spectrum(history)].into_iter().flatten());
        let contour = passage.space_time.as_ref().map(space_time);
        Passage {
            title: passage.title.clone(),
            run_id: passage.run_id.clone(),
            figures: histories.chain(contour).collect(),
        }
    };
    input.passages.iter().map(of).collect()
}

fn over_time(history: &History) -> Figure {
    let (factor, unit) = readable(&history.unit);
    let curve = |name: &str, class: &str, values: &[f64]| Curve {
        name: name.into(),
        class: class.into(),
        points: thin(&history.time.iter().zip(values).map(|(t, y)| [*t, y * factor]).collect::<Vec<_>>(), 600),
        dots: Vec::new(),
    };
    let mut curves = vec![curve("raw", "c2 thin", &history.raw)];
    if !history.filtered.is_empty() {
        curves.push(curve(&history.filter, "c1 bold", &history.filtered));
    }
    let chart = Chart {
        name: format!("{} over time", history.title),
        x_name: "time, s".into(),
        y_name: if unit.is_empty() { "1".into() } else { unit.into() },
        curves,
        height: 240.0,
        ..Chart::default()
    };
    let greatest = |values: &[f64]| values.iter().map(|x| x.abs()).fold(0.0, f64::max) * factor;
    let raw = crate::number::digits(greatest(&history.raw), 4);
    let behind = match history.filtered[..] {
        [] => String::new(),
        _ => format!(", behind {} {}", history.filter, crate::number::digits(greatest(&history.filtered), 4)),
    };
    let note = format!("Greatest amount: raw {raw}{behind} {unit}.");
    Figure { title: history.title.clone(), svg: chart.svg(), note, table: super::Table::default() }
}

fn spectrum(history: &History) -> Option<Figure> {
    let n = history.raw.len();
    let [first, .., last] = history.time[..] else { return None };
    let rate = (n - 1) as f64 / (last - first);
    let seconds = n as f64 / rate;
    let highest = history.cut_off.map_or(60.0, |f| 1.5 * f).min(0.5 * rate);
    let count = ((highest * seconds) as usize).min(n / 2);
    let step = count.div_ceil(LINES).max(1);
    let (factor, unit) = readable(&history.unit);
    let amplitude = |i: usize| {
        let (sin, cos) = (2.0 * PI * i as f64 / n as f64).sin_cos();
        let (mut re, mut im) = (0.0, 0.0);
        for a in history.raw.iter().rev() {
            (re, im) = (re * cos + im * sin + a, im * cos - re * sin);
        }
        2.0 / n as f64 * f64::hypot(re, im)
    };
    // Of lines that are too close for the picture the greatest stands for its neighbours.
    let points: Vec<[f64; 2]> = (1..=count)
        .step_by(step)
        .map(|i| {
            let greatest = (i..(i + step).min(count + 1)).map(amplitude).fold(0.0, f64::max);
            [i as f64 / seconds, greatest * factor]
        })
        .collect();
    if points.len() < 3 {
        return None;
    }
    let mark = history.cut_off.map(|f| Line {
        at: f,
        name: format!("cut-off {} Hz", crate::number::short(f)),
        class: "resonance",
    });
    let chart = Chart {
        name: format!("Spectrum of {}", history.title),
        x_name: "frequency, Hz".into(),
        y_name: format!("amplitude, {unit}"),
        curves: vec![Curve { name: "raw".into(), class: "c1".into(), points, dots: Vec::new() }],
        upright: mark.into_iter().collect(),
        height: 200.0,
        from_zero: true,
        ..Chart::default()
    };
    let note = "Amplitudes of the whole record, rectangular window.".into();
    Some(Figure {
        title: format!("Spectrum: {}", history.title),
        svg: chart.svg(),
        note,
        table: super::Table::default(),
    })
}

fn space_time(of: &SpaceTime) -> Figure {
    let greatest = of.values.iter().flatten().map(|a| a.abs()).fold(0.0, f64::max).max(1e-300);
    let class = |share: f64| match share {
        s if s > 0.6 => "p3",
        s if s > 0.3 => "p2",
        s if s > 0.1 => "p1",
        s if s < -0.6 => "n3",
        s if s < -0.3 => "n2",
        s if s < -0.1 => "n1",
        _ => "h0",
    };
    let rows: Vec<String> = vec![String::new(); of.values.len()];
    let values: Vec<Vec<Option<f64>>> =
        of.values.iter().map(|row| row.iter().map(|a| Some(a / greatest)).collect()).collect();
    let height = (320.0 / of.values.len().max(1) as f64).max(0.5);
    // An axle from the deck's begin to its end, as far as the times go.
    let (t0, t1) = (of.time.first().copied().unwrap_or(0.0), of.time.last().copied().unwrap_or(0.0));
    let row = |t: f64| (t - t0) / (t1 - t0).max(f64::MIN_POSITIVE) * of.values.len() as f64;
    let within = |path: &&[[f64; 2]; 2]| path[0][0] >= t0 && path[1][0] <= t1;
    let lines: Vec<[[f64; 2]; 2]> = of.paths.iter().filter(within).map(|path| path.map(|[t, x]| [x, row(t)])).collect();
    let svg = cells(&Cells {
        name: "Acceleration of the deck over place and time",
        x_name: "from the begin of the bridge, m; time downwards",
        x: &of.x,
        rows: &rows,
        values: &values,
        class: &class,
        height,
        lines: &lines,
    });
    let (from, to) = (of.time.first().copied().unwrap_or(0.0), of.time.last().copied().unwrap_or(0.0));
    let note = format!(
        "Time from {from:.3} s above to {to:.3} s below. Steps at 10, 30 and 60 % of {} m/s², two colours for down and up; lines: axles.",
        crate::number::digits(greatest, 3)
    );
    Figure { title: "Acceleration of the deck over place and time".into(), svg, note, table: super::Table::default() }
}
