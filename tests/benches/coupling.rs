//! Trials a step by method, step and mass of the bridge, on R1 and on the default example:
//! `cargo bench -p ttb-tests --bench coupling [-- METHOD… PREDICTOR…]`.

use std::time::Instant;

use ttb_coupling::{Coupling, Method, Predictor, Settings};
use ttb_scenario::Checked;
use ttb_session::{Case, Plan, Sides, Table};
use ttb_tests::{example, r1_with, sides};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let asked =
        |name: &str, all: &[&str]| words.iter().any(|w| w == name) || !words.iter().any(|w| all.contains(&w.as_str()));
    let methods = [Method::FixedPoint, Method::Aitken, Method::IqnIls, Method::Newton, Method::Auto];
    let names: Vec<&str> = methods.iter().map(|m| m.name()).collect();
    let predictors = [
        ("constant", Predictor::Constant),
        ("linear", Predictor::Linear),
        ("quadratic", Predictor::Quadratic),
        ("cubic", Predictor::Cubic),
    ];
    let predictor_names = predictors.map(|(name, _)| name);
    let reuse: Option<usize> = words.iter().find_map(|w| w.strip_prefix("reuse=").and_then(|w| w.parse().ok()));
    let mut cases: Vec<(String, Checked)> = Vec::new();
    for mass in [29_720.0, 1500.0, 1000.0, 500.0] {
        for h in [1e-3, 2e-3, 5e-3] {
            cases.push((format!("R1 {:5.2} t/m, {} ms", mass / 1e3, h * 1e3), r1_with(mass, h)));
        }
    }
    if words.iter().any(|w| w == "default") {
        cases = vec![("default example".into(), example("default.json"))];
    }
    for (name, checked) in &cases {
        for (predictor_name, predictor) in predictors.iter().filter(|p| asked(p.0, &predictor_names)) {
            for method in methods.iter().filter(|m| asked(m.name(), &names)) {
                let mut settings = Case::of(checked).settings;
                (settings.method, settings.predictor) = (*method, *predictor);
                settings.reuse = reuse.unwrap_or(settings.reuse);
                println!("{name}, {predictor_name:9}, {:11} {}", method.name(), describe(checked, settings));
            }
        }
    }
}

fn describe(checked: &Checked, settings: Settings) -> String {
    let (axis, mut sides, mut table) = (Case::of(checked).axis(), sides(checked), Table::default());
    sides.coupling = Coupling::new(sides.coupling.ports().clone(), settings);
    let begin = Instant::now();
    let plan = Plan { axis, wanted: &|_| false, clock: &|| 0.0 };
    let ended = sides.run(&plan, &mut [&mut table]);
    let Sides { coupling, .. } = &sides;
    let report = coupling.report();
    let sum = |of: fn(&ttb_coupling::StepInfo) -> usize| table.steps.iter().map(of).sum::<usize>();
    let (trials, alone, rescues) = (sum(|s| s.iterations), sum(|s| s.train_track_trials), sum(|s| s.rescues));
    let most = table.steps.iter().map(|s| s.iterations).max().unwrap_or(0);
    let (rho, extra) = (report.contraction.unwrap_or(f64::NAN), report.identification_trials);
    let steps = axis.steps() as f64;
    let micros = 1e6 * begin.elapsed().as_secs_f64() / steps;
    let (mean, alone) = (trials as f64 / steps, f64::from(alone as u32) / steps);
    match ended {
        Ok(_) => {
            let switches: Vec<String> =
                report.switches.iter().map(|(t, m)| format!("{} from {t:.3} s", m.name())).collect();
            let notes = switches.join(", ");
            format!(
                "ρ₀ {rho:6.3}  mean {mean:5.2} (train–track {alone:5.2})  max {most:2}  rescues {rescues}  extra {extra:3}  {micros:6.1} µs  {notes}"
            )
        }
        Err(error) => format!("ρ₀ {rho:6.3}  FAILED: {error}"),
    }
}
