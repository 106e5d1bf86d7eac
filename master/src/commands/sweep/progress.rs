//! Progress of many runs: a bar with the time left on a terminal, a line a minute elsewhere.

use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use ttb_campaign::pool::Progress;

/// Between two lines where there is no terminal.
const PAUSE: Duration = Duration::from_secs(60);

/// Tells how far it is.
pub struct Told {
    quiet: bool,
    bar: Option<ProgressBar>,
    begin: Instant,
    last: Mutex<Instant>,
}

impl Told {
    /// From now on.
    pub fn new(quiet: bool) -> Self {
        let bar = (!quiet && std::io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template("{bar:40} {pos}/{len} runs, {eta} left{msg}");
            bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        });
        let begin = Instant::now();
        Self { quiet, bar, begin, last: Mutex::new(begin) }
    }

    /// Of `count` runs so many are done.
    pub fn tell(&self, count: usize, progress: Progress) {
        let Progress { done, failed, .. } = progress;
        let failed = if failed > 0 { format!(", {failed} failed") } else { String::new() };
        if let Some(bar) = &self.bar {
            bar.set_length(count as u64);
            bar.set_message(failed);
            bar.set_position(done as u64);
            return;
        }
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if !self.quiet && last.elapsed() >= PAUSE {
            *last = Instant::now();
            let left = self.begin.elapsed().as_secs_f64() * (count - done) as f64 / done.max(1) as f64;
            note!("ttb: {done} of {count} runs{failed}, {} left", duration(left));
        }
    }

    /// Clears the bar.
    pub fn end(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Seconds as people say them.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 0.95 => format!("{s:.1} s"),
        s if s < 99.5 => format!("{s:.0} s"),
        s if s < 5400.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
