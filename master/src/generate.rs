//! `ttb generate`: bridge models made from a few numbers, each with a scenario that runs a train over it.

use std::path::Path;

use ttb_generate::{
    CableStayed, Refused, Viaduct, cable_stayed, cable_stayed_scenario, text, viaduct, viaduct_scenario,
};

use crate::cli::{Generate, Generated};
use crate::error::Error;

/// Names of the two files.
const MODEL: &str = "bridge.json";
const SCENARIO: &str = "scenario.json";

/// The command.
pub fn generate(arguments: &Generate) -> Result<(), Error> {
    let refused = |refused: Refused| Error::Input(refused.to_string());
    let (model, scenario) = match &arguments.what {
        Generated::CableStayed { dofs, track_y, approach } => {
            let asked = CableStayed { dofs: *dofs, track_y: *track_y, approach: *approach };
            let model = cable_stayed(&asked).map_err(refused)?;
            let scenario = cable_stayed_scenario(&model, MODEL);
            (model, scenario)
        }
        Generated::Viaduct { spans, span, width, depth, dofs, track_y } => {
            let asked =
                Viaduct { spans: *spans, span: *span, width: *width, depth: *depth, track_y: *track_y, dofs: *dofs };
            let model = viaduct(&asked).map_err(refused)?;
            let scenario = viaduct_scenario(&model, *spans, MODEL);
            (model, scenario)
        }
    };
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
    write(&folder.join(MODEL), &text(&model))?;
    write(&folder.join(SCENARIO), &scenario)?;
    let freedoms = ttb_generate::measure::degrees_of_freedom(&model);
    let mass = ttb_generate::measure::mass(&model, |_| true) * 1e-3;
    say!("{}: {freedoms} degrees of freedom, {mass:.0} t", folder.join(MODEL).display());
    say!("ttb run {}", folder.join(SCENARIO).display());
    Ok(())
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    std::fs::write(path, text).map_err(Error::io(path))
}
