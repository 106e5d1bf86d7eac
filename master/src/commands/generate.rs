//! `ttb generate`: bridge models made from a few numbers, each with scenarios that run a train over it.

use std::path::Path;

use ttb_generate::{
    CableStayed, Refused, Viaduct, cable_stayed, cable_stayed_scenario, text, viaduct, viaduct_scenario,
};

use crate::cli::{Generate, Generated};
use crate::error::Error;

/// Names of the files.
const MODEL: &str = "bridge.json";
const SCENARIO: &str = "scenario.json";
/// The same with a reduced bridge, and its highest frequency, Hz: displacements of the cable-stayed bridge under the train
/// then differ by less than 1e-5, accelerations of its deck by less than 5e-3.
const REDUCED: (&str, f64) = ("reduced.json", 50.0);

/// The command.
pub fn generate(arguments: &Generate) -> Result<(), Error> {
    let refused = |refused: Refused| Error::Input(refused.to_string());
    let (model, scenario, reduced) = match &arguments.what {
        Generated::CableStayed { dofs, track_y, approach } => {
            let asked = CableStayed { dofs: *dofs, track_y: *track_y, approach: *approach };
            let model = cable_stayed(&asked).map_err(refused)?;
            let [scenario, reduced] =
                [None, Some(REDUCED.1)].map(|highest| cable_stayed_scenario(&model, MODEL, highest));
            (model, scenario, Some(reduced))
        }
        Generated::Viaduct { spans, span, width, depth, dofs, track_y } => {
            let asked =
                Viaduct { spans: *spans, span: *span, width: *width, depth: *depth, track_y: *track_y, dofs: *dofs };
            let model = viaduct(&asked).map_err(refused)?;
            let scenario = viaduct_scenario(&model, *spans, MODEL);
            (model, scenario, None)
        }
    };
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
    write(&folder.join(MODEL), &text(&model))?;
    write(&folder.join(SCENARIO), &scenario)?;
    if let Some(reduced) = &reduced {
        write(&folder.join(REDUCED.0), reduced)?;
    }
    let freedoms = ttb_generate::measure::degrees_of_freedom(&model);
    let mass = ttb_generate::measure::mass(&model, |_| true) * 1e-3;
    say!("{}: {freedoms} degrees of freedom, {mass:.0} t", folder.join(MODEL).display());
    say!("ttb run {}", folder.join(SCENARIO).display());
    if reduced.is_some() {
        say!("ttb run {}    in modes up to {} Hz, much faster", folder.join(REDUCED.0).display(), REDUCED.1);
    }
    Ok(())
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    std::fs::write(path, text).map_err(Error::io(path))
}
