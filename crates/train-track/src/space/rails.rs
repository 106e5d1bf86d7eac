//! The track in space: the plane track carries the sum of both rails' vertical motion, lines carry the rest.
//!
//! | motion | slab | with sleepers |
//! |---|---|---|
//! | w_s | plane track | plane track |
//! | w_a | a line | one line with sleeper (y, φ) and ballast |
//! | v_s, φ_s | a line | the same |
//! | v_d, φ_d | a line | a line: the sleeper is rigid |
//!
//! ```text
//! e_z = w − d_z − d_φ Y,   e_y = v − φ h_f − d_y,   e_φ = φ − d_φ          Y = σ y_r; sums and differences decouple
//! ballast under a sleeper: k/2 each at ±y_b → k y_b² (φ − d_φ);  lateral ballast on y − d_y
//! ```

use ttb_dynamics::beam::Beam;
use ttb_scenario::spec::{SpaceTrack, TrainTrackSpec};
use ttb_scenario::types::{Spring, Support};

use super::line::{Description, Field, Line, SupportSpring};
use crate::track::FastenerFactors;

/// Ports of the rails: positions in a [`super::newton::RailBlock`].
pub const W_SUM: usize = 0;
const W_DIFFERENCE: usize = 1;
const V_SUM: usize = 2;
const PHI_SUM: usize = 3;
const V_DIFFERENCE: usize = 4;
const PHI_DIFFERENCE: usize = 5;

/// Lines, each with the rail ports that its own ports are.
pub fn lines(spec: &TrainTrackSpec, space: &SpaceTrack, factors: FastenerFactors) -> Vec<(Line, Vec<usize>)> {
    let rail = &spec.track.rail;
    let scaled = |s: Spring, by: f64| Spring {
        stiffness: by * s.stiffness * factors.stiffness,
        damping: by * s.damping * factors.damping,
    };
    let vertical = Field::Bending(Beam {
        bending_stiffness: rail.bending_stiffness,
        mass: rail.mass,
        shear_stiffness: rail.shear_stiffness,
        rotary_inertia: rail.rotary_inertia,
    });
    let lateral = Field::Bending(Beam {
        bending_stiffness: 2.0 * space.lateral_bending_stiffness,
        mass: rail.mass,
        shear_stiffness: None,
        rotary_inertia: 0.0,
    });
    let torsion = Field::Torsion { stiffness: 2.0 * space.torsional_stiffness, inertia: 2.0 * space.polar_inertia };
    let (pad_y, pad_phi) = (scaled(space.lateral, 2.0), scaled(space.rolling, 2.0));
    let (yr, hf) = (space.half_distance, space.foot_height);
    let line = |fields: Vec<Field>, masses: Vec<f64>, springs: Vec<SupportSpring>, shear: Option<(usize, Spring)>| {
        let (bays, per_bay) = (spec.bays, spec.elements_per_bay);
        let length = spec.track.spacing / per_bay as f64;
        Line::new(Description { fields, masses, springs, shear, bays, per_bay, length }, &spec.on_bridge)
    };
    const NONE: (usize, f64) = (0, 0.0);
    let spring = |of: [(usize, f64); 3], spring: Spring, deck: Option<[f64; 2]>| SupportSpring { of, spring, deck };
    let apart = line(
        vec![lateral, torsion],
        Vec::new(),
        vec![spring([(0, 1.0), (2, -hf), NONE], pad_y, None), spring([(2, 1.0), NONE, NONE], pad_phi, None)],
        None,
    );
    let mut lines = match (&spec.track.support, &space.sleeper) {
        (Support::SingleLayer { fastener }, _) => {
            slab(&line, [vertical, lateral, torsion], scaled(*fastener, 1.0), [pad_y, pad_phi], [yr, hf])
        }
        (Support::TwoLayer { pad, .. } | Support::ThreeLayer { pad, .. }, None) => {
            // Without the sleeper's data it is rigid with the deck.
            slab(&line, [vertical, lateral, torsion], scaled(*pad, 1.0), [pad_y, pad_phi], [yr, hf])
        }
        (support, Some(sleeper)) => {
            let (pad, mass, ballast, below) = match *support {
                Support::TwoLayer { pad, sleeper_mass, ballast } => (pad, sleeper_mass, ballast, None),
                Support::ThreeLayer { pad, sleeper_mass, ballast, ballast_mass, shear, sub_ballast } => {
                    (pad, sleeper_mass, ballast, Some((ballast_mass, shear, sub_ballast)))
                }
                Support::SingleLayer { fastener } => (fastener, 0.0, fastener, None),
            };
            // Places: w θ v ψ φ of the rails, then y and φ of the sleeper, then the ballast's difference.
            let yb = sleeper.half_distance;
            let mut masses = vec![mass, sleeper.roll_inertia];
            let mut springs = vec![
                spring([(0, 1.0), (6, -yr), NONE], scaled(pad, 1.0), None),
                spring([(2, 1.0), (4, -hf), (5, -1.0)], pad_y, None),
                spring([(4, 1.0), (6, -1.0), NONE], pad_phi, None),
                spring([(5, 1.0), NONE, NONE], sleeper.lateral, Some([1.0, 0.0])),
            ];
            let mut shear = None;
            match below {
                None => springs.push(spring([(6, yb), NONE, NONE], ballast, Some([0.0, yb]))),
                Some((ballast_mass, between, sub_ballast)) => {
                    masses.push(ballast_mass);
                    springs.push(spring([(6, yb), (7, -1.0), NONE], ballast, None));
                    springs.push(spring([(7, 1.0), NONE, NONE], sub_ballast, Some([0.0, yb])));
                    shear = between.map(|spring| (2, spring));
                }
            }
            let together = line(vec![vertical, lateral, torsion], masses, springs, shear);
            vec![(together, vec![W_DIFFERENCE, V_SUM, PHI_SUM])]
        }
    };
    lines.push((apart, vec![V_DIFFERENCE, PHI_DIFFERENCE]));
    lines
}

/// Rails on fasteners that stand on the deck: vertical differences, and lateral sums with torsion.
fn slab(
    line: &impl Fn(Vec<Field>, Vec<f64>, Vec<SupportSpring>, Option<(usize, Spring)>) -> Line,
    [vertical, lateral, torsion]: [Field; 3],
    fastener: Spring,
    [pad_y, pad_phi]: [Spring; 2],
    [yr, hf]: [f64; 2],
) -> Vec<(Line, Vec<usize>)> {
    const NONE: (usize, f64) = (0, 0.0);
    let tilt = vec![SupportSpring { of: [(0, 1.0), NONE, NONE], spring: fastener, deck: Some([0.0, yr]) }];
    let sway = vec![
        SupportSpring { of: [(0, 1.0), (2, -hf), NONE], spring: pad_y, deck: Some([1.0, 0.0]) },
        SupportSpring { of: [(2, 1.0), NONE, NONE], spring: pad_phi, deck: Some([0.0, 1.0]) },
    ];
    vec![
        (line(vec![vertical], Vec::new(), tilt, None), vec![W_DIFFERENCE]),
        (line(vec![lateral, torsion], Vec::new(), sway, None), vec![V_SUM, PHI_SUM]),
    ]
}
