//! What is drawn of a bridge, against closed forms.

mod common;
mod girders;

use std::f64::consts::PI;

use common::{beams, bridge, near, span};
use girders::{EI, L, MASS, girder};
use ttb_bridge::drawing::Drawing;
use ttb_scenario::GRAVITY;
use ttb_scenario::spec::StructureSpec;

#[test]
fn a_beam_sags_and_vibrates_as_a_beam_does_and_down_is_down() {
    let plane = beams(vec![span(L, EI, MASS, 20)], 10, 1e-3);
    let space = bridge(StructureSpec::FiniteElements(Box::new(girder(20, 0.0))), L, 10, 1e-3);
    for (name, spec) in [("plane", plane), ("space", space)] {
        let drawing = Drawing::new(&spec).expect(name);
        assert_eq!((drawing.points.len(), drawing.cells.len()), (21, 20), "{name}");
        assert_eq!(drawing.cells[3], [3, 4], "{name}");
        let sag = 5.0 * MASS * GRAVITY * L.powi(4) / (384.0 * EI);
        // z is up.
        near(name, drawing.sag()[10][2], -sag, 1e-8);
        let modes = drawing.modes(2).expect(name);
        let f1 = PI / (2.0 * L * L) * (EI / MASS).sqrt();
        let vertical = modes.iter().find(|mode| mode.displacements[10][2].abs() > 0.5).expect("a bending mode");
        near(name, vertical.frequency, f1, 1e-5);
        near(name, vertical.displacements[10][2].abs(), 1.0, 1e-12);
        let shape = vertical.displacements[4][2] / vertical.displacements[10][2];
        near(name, shape, (PI * 4.0 / 20.0).sin(), 1e-6);
    }
}
