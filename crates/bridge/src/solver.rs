//! How a structure is solved: in all degrees of freedom, in its lowest modes, or in a reduced model.

use std::sync::Arc;

use ttb_contract::ModelError;
use ttb_dynamics::newmark::Newmark;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::Damping;
use ttb_sparse::modes::Modes;
use ttb_sparse::{Factor, Pencil};

use crate::deck::Row;
use crate::full::Full;
use crate::law::{law, ratio};
use crate::reduced::Reduced;
use crate::reduction::{self, Accuracy, Built, Supports};
use crate::rows::Rows;
use crate::stored::Source;
use crate::system::System;

/// How a structure is solved.
pub struct Solver {
    /// The equations, ready for steps.
    pub system: Arc<dyn System>,
    /// R, over the unknowns.
    pub rows: Rows,
    /// A reduced model's error against all degrees of freedom.
    pub accuracy: Option<Accuracy>,
    /// What the FMU keeps in a file of its own, if it does.
    pub source: Option<Source>,
    /// What the user should know of it.
    pub remark: Option<String>,
}

impl Solver {
    /// All degrees of freedom, the lowest modes, or a reduced model; `rows` are those of supports, as many as `ports`, and
    /// monitors.
    ///
    /// # Errors
    /// The reduced model cannot be made.
    pub fn new(
        spec: &BridgeSpec,
        pencil: Arc<Pencil>,
        statics: Arc<Factor>,
        mut modes: Modes,
        rows: &[Row],
        ports: usize,
    ) -> Result<Self, ModelError> {
        // Plane models and lowest modes are made anew from their few numbers.
        let small = matches!(spec.structure, StructureSpec::Beams { .. } | StructureSpec::Frame(_));
        if let Some(wish) = &spec.reduction {
            let law = law(&spec.damping, &modes.omega2, ratio(&spec.damping), 1.0, 1.0)?;
            let newmark = Newmark::new(spec.newmark.gamma, spec.newmark.beta, spec.step);
            let Built { system, rows, accuracy, remark } = reduction::build(
                &pencil,
                &statics,
                &law,
                newmark,
                rows,
                Supports { stations: &spec.supports, ports },
                wish,
            )?;
            let source = Some(Source::Reduced { omega2: system.omega2().to_vec() });
            return Ok(Self { system: Arc::new(system), rows, accuracy: Some(accuracy), source, remark });
        }
        let rows = Rows::new(rows);
        if let Some(count) = spec.modes {
            modes.shapes.truncate(count);
            modes.omega2.truncate(count);
            let source = (!small).then(|| Source::Reduced { omega2: modes.omega2.clone() });
            let rows = rows.project(&modes.shapes);
            return Ok(Self {
                system: Arc::new(Reduced::new(modes.omega2)),
                rows,
                accuracy: None,
                source,
                remark: None,
            });
        }
        let damped = if matches!(spec.damping, Damping::Modal { .. }) { modes } else { Modes::default() };
        let shapes = damped.shapes.clone();
        let source = (!small).then(|| Source::Full { pencil: Arc::clone(&pencil), shapes });
        Ok(Self {
            system: Arc::new(Full::new(pencil, Some(statics), damped)),
            rows,
            accuracy: None,
            source,
            remark: None,
        })
    }
}
