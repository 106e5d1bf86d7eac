//! Wheel profiles: s = 0 at the taping line, flange back at s = −70 mm, z = 0 at the taping line.
//!
//! S1002 after EN 13715, annex B: eight sections A to H. A cone has the same flange, 70°, joined to the tread by R13.

use super::{Piece, Shape};

/// Flange back, mm from the taping line.
pub const FLANGE_BACK: f64 = -70.0;
/// Field side, mm from the taping line.
const FIELD_SIDE: f64 = 60.0;
/// z of the flange's 70° line at s = 0, mm, and its slope.
const FLANGE_LINE: [f64; 2] = [-93.576_667_419, -2.747_477_419];

/// Sections F, G and H: flange top and back, up to the 70° line.
fn flange() -> Vec<(f64, Piece)> {
    let arc = |s, z, radius, above| Piece::Arc { centre: [s, z], radius, above };
    vec![
        (-62.764_705_882, arc(-49.5, 9.519_259_302, 20.5, false)),
        (-49.662_510_381, arc(-55.0, 16.0, 12.0, false)),
        (-39.764_473_993, arc(-58.558_326_413, 8.834_924_130, 20.0, false)),
    ]
}

fn line([z0, slope]: [f64; 2]) -> Piece {
    Piece::Polynomial { origin: 0.0, coefficients: vec![z0, slope] }
}

/// S1002.
///
/// # Errors
/// None with the numbers here; the check of [`Shape::new`].
pub fn s1002() -> Result<Shape, String> {
    let polynomial = |coefficients: &[f64]| Piece::Polynomial { origin: 0.0, coefficients: coefficients.to_vec() };
    let c = [
        -4.320_221_063e3,
        -1.038_384_026e3,
        -1.065_501_873e2,
        -6.051_367_875,
        -2.054_332_446e-1,
        -4.169_739_389e-3,
        -4.687_195_829e-5,
        -2.252_755_540e-7,
    ];
    let b = [
        0.0,
        -3.358_537_058e-2,
        1.565_681_624e-3,
        -2.810_427_944e-5,
        5.844_240_864e-8,
        -1.562_379_023e-8,
        5.309_217_349e-15,
        -5.957_839_843e-12,
        2.646_656_573e-13,
    ];
    let mut pieces = flange();
    pieces.extend([
        (-38.426_669_071, line(FLANGE_LINE)),
        (-35.0, Piece::Arc { centre: [-26.210_665, 16.446], radius: 13.0, above: true }),
        (-26.0, polynomial(&c)),
        (32.158, polynomial(&b)),
        (FIELD_SIDE, polynomial(&[1.364_323_640, -0.066_666_667])),
    ]);
    Shape::new(FLANGE_BACK, pieces)
}

/// A cone z = −λ s with the flange of S1002, root radius 13 mm.
///
/// # Errors
/// A conicity λ outside 0…0.5, with which tread and flange do not meet.
pub fn cone(conicity: f64) -> Result<Shape, String> {
    const ROOT: f64 = 13.0;
    if !(0.0..=0.5).contains(&conicity) {
        return Err(format!("the conicity of a wheel is {conicity}; it must lie between 0 and 0.5"));
    }
    // The root's centre lies 13 mm below both lines z = z0 + m s:  z = z0 + m s + R √(1 + m²).
    let [z0, m] = FLANGE_LINE;
    let below = |slope: f64| ROOT * (1.0 + slope * slope).sqrt();
    let s = (below(conicity) - z0 - below(m)) / (m + conicity);
    let centre = [s, below(conicity) - conicity * s];
    // It touches a line of slope m at s_m + R m/√(1 + m²).
    let touch = |slope: f64| s + ROOT * slope / (1.0 + slope * slope).sqrt();
    let mut pieces = flange();
    pieces.extend([
        (touch(m), line(FLANGE_LINE)),
        (touch(-conicity), Piece::Arc { centre, radius: ROOT, above: true }),
        (FIELD_SIDE, line([0.0, -conicity])),
    ]);
    Shape::new(FLANGE_BACK, pieces)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sections_of_s1002_meet() {
        let wheel = s1002().unwrap();
        assert!(wheel.largest_step() < 1.5e-4, "{}", wheel.largest_step());
        assert_eq!(wheel.at(0.0).z, 0.0);
        assert!((wheel.at(-55.0).z - 28.0).abs() < 1e-12, "height of the flange");
    }

    #[test]
    fn a_cone_meets_its_flange_without_a_kink() {
        for conicity in [0.0, 0.025, 0.05] {
            let wheel = cone(conicity).unwrap();
            assert!(wheel.largest_step() < 1e-6, "{conicity}: {}", wheel.largest_step());
            for (i, (end, piece)) in wheel.pieces.iter().enumerate().take(wheel.pieces.len() - 1).skip(2) {
                let kink = piece.at(*end).slope - wheel.pieces[i + 1].1.at(*end).slope;
                assert!(kink.abs() < 1e-6, "{conicity}: {kink} at {end}");
            }
        }
        assert!(cone(f64::NAN).is_err());
    }
}
