//! Cycles of a history by rainflow counting, ASTM E1049-85 5.4.4: whole cycles where a range is enclosed, half cycles at the
//! beginning of the history and for what remains at its end.

/// Cycles of one range and mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// Greatest less least value.
    pub range: f64,
    /// Mean of both.
    pub mean: f64,
    /// 0.5 or 1.
    pub count: f64,
}

impl Cycle {
    fn of(a: f64, b: f64, count: f64) -> Self {
        Self { range: (a - b).abs(), mean: 0.5 * (a + b), count }
    }
}

/// The first and the last value, and every turn between them.
fn turns(history: &[f64]) -> Vec<f64> {
    let mut turns: Vec<f64> = Vec::new();
    for value in history {
        match turns[..] {
            [.., last] if last == *value => {}
            [.., before, last] if (last - before) * (value - last) > 0.0 => {
                let end = turns.len() - 1;
                turns[end] = *value;
            }
            _ => turns.push(*value),
        }
    }
    turns
}

/// All cycles in the order in which they close.
pub fn rainflow(history: &[f64]) -> Vec<Cycle> {
    let mut cycles = Vec::new();
    let mut open: Vec<f64> = Vec::new();
    for turn in turns(history) {
        open.push(turn);
        while let [.., a, b, c] = open[..] {
            if (c - b).abs() < (b - a).abs() {
                break;
            }
            if open.len() == 3 {
                cycles.push(Cycle::of(a, b, 0.5));
                open.remove(0);
            } else {
                cycles.push(Cycle::of(a, b, 1.0));
                open.truncate(open.len() - 3);
                open.push(c);
            }
        }
    }
    cycles.extend(open.windows(2).map(|pair| Cycle::of(pair[0], pair[1], 0.5)));
    cycles
}
