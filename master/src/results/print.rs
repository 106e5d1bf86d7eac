//! The few lines of a summary that people read.

use std::path::Path;

use ttb_session::Quantity;
use ttb_session::column::{Column, Kind};

use super::summary::Summary;

impl Summary<'_> {
    /// A short summary for people.
    pub fn print(&self, folder: &Path) {
        say!("{}", self.title);
        let (i, s) = (self.iterations, self.seconds);
        let parts = match self.substeps {
            1 => String::new(),
            m => format!(" (train and track {m} a step)"),
        };
        say!("  {} steps of {} s{parts} to t = {} s: {}", i.steps, self.step_s, self.reached_s, self.status);
        say!("  iterations      mean {:.2}, max {}, residual ≤ {:.1e}", i.mean, i.max, i.max_residual);
        if let Some(coupling) = &self.coupling {
            coupling.print();
        }
        say!(
            "  seconds         {:.2} stepping ({:.1} × real time): train–track {:.2}, bridge {:.2}, master {:.3}, results {:.2}; start {:.2}",
            s.stepping,
            self.times_faster_than_real_time,
            s.train_track,
            s.bridge,
            s.master,
            s.recording,
            s.initialization
        );
        if i.not_converged > 0 {
            say!("  NOT CONVERGED   {} of {} steps were accepted all the same", i.not_converged, i.steps);
        }
        if self.peaks.0.is_empty() {
            say!("  peaks           none: no wheel had come onto the bridge");
        }
        let columns: Vec<Column> = self.peaks.0.iter().map(|peak| Column::parse(&peak.name, &peak.unit)).collect();
        let at_points = self.peaks.0.iter().zip(&columns).filter(|(_, column)| column.of.kind() == Kind::Point);
        for (peak, _) in at_points {
            let (factor, unit) = readable(&peak.unit);
            let (low, high) = (&peak.min, &peak.max);
            say!(
                "  {:<34} {:>10.4} … {:<10.4} {unit}, at t = {:.3} s and {:.3} s",
                peak.name,
                low.value * factor,
                high.value * factor,
                low.time,
                high.time
            );
        }
        self.print_over(&columns, Kind::Car, &Quantity::Acceleration, "car bodies, acceleration");
        self.print_over(&columns, Kind::Wheel, &Quantity::ContactForce, "wheelsets, contact force");
        for loss in &self.contact_losses {
            say!(
                "  wheel {} lost contact {} times, {:.4} s in all, {:.4} s at most",
                loss.wheel,
                loss.intervals,
                loss.seconds,
                loss.longest
            );
        }
        say!("  results in {}", folder.display());
    }

    /// Extremes over all variables of a kind.
    fn print_over(&self, columns: &[Column], kind: Kind, quantity: &Quantity, text: &str) {
        let own = self.peaks.0.iter().zip(columns).filter(|(_, column)| column.is(kind, quantity));
        let of_kind = || own.clone().map(|(peak, _)| peak);
        let low = of_kind().min_by(|a, b| a.min.value.total_cmp(&b.min.value));
        let high = of_kind().max_by(|a, b| a.max.value.total_cmp(&b.max.value));
        if let (Some(low), Some(high)) = (low, high) {
            let (factor, unit) = readable(&low.unit);
            let (a, b) = (low.min.value * factor, high.max.value * factor);
            say!("  {text:<34} {a:>10.4} … {b:<10.4} {unit}, at {} and {}", low.name, high.name);
        }
    }
}

/// Factor and name of the unit people read.
fn readable(unit: &str) -> (f64, &str) {
    match unit {
        "m" => (1e3, "mm"),
        "N" => (1e-3, "kN"),
        "N.m" => (1e-3, "kN.m"),
        "m/s2" => (1.0, "m/s²"),
        other => (1.0, other),
    }
}
