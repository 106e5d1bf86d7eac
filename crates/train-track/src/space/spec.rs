//! From the specification to cars, contact and lines.

use ttb_scenario::spec::{SpaceContact, SpaceTrack};
use ttb_scenario::types::{Creep as CreepName, ProfileCurve, ProfileShape};
use ttb_wheel_rail::contact::Settings;
use ttb_wheel_rail::creep::Creep;
use ttb_wheel_rail::geometry::{Geometry, Pairing, of_profiles};
use ttb_wheel_rail::hertz::Material;
use ttb_wheel_rail::profile::rail::Placed;
use ttb_wheel_rail::profile::spline::through;
use ttb_wheel_rail::profile::{Piece, Shape};

/// A profile.
///
/// # Errors
/// Pieces or points that make none.
pub fn shape(profile: &ProfileShape) -> Result<Shape, String> {
    let pieces = match profile {
        ProfileShape::PointsMm(points) => return through(points),
        ProfileShape::PiecesMm(pieces) => pieces,
    };
    let piece = |curve: &ProfileCurve| match curve {
        ProfileCurve::Polynomial(coefficients) => Piece::Polynomial { origin: 0.0, coefficients: coefficients.clone() },
        ProfileCurve::Arc([s, z, radius, sign]) => Piece::Arc { centre: [*s, *z], radius: *radius, above: *sign < 0.0 },
    };
    let start = pieces.first().map_or(0.0, |piece| piece.from);
    Shape::new(start, pieces.iter().map(|of| (of.to, piece(&of.curve))).collect())
}

/// The table of a wheel on a rail.
///
/// # Errors
/// Profiles or distances that make none.
pub fn geometry(contact: &SpaceContact, track: &SpaceTrack) -> Result<Geometry, String> {
    let wheel = shape(&contact.wheel).map_err(|e| format!("wheel profile: {e}"))?;
    let rail = shape(&contact.rail).map_err(|e| format!("rail profile: {e}"))?;
    let rail = Placed::new(rail, track.inclination, 1e3 * track.gauge)?;
    let back_to_back = 1e3 * contact.back_to_back;
    let flange_back = 0.5 * back_to_back - 1e3 * contact.taping_line;
    of_profiles(
        &wheel,
        &rail,
        &Pairing { back_to_back, flange_back, softness: 1e3 * contact.softness, ..Pairing::default() },
    )
}

/// Elasticity and creep of the contact of wheels with the radius r0 and the friction coefficient `friction`.
pub fn settings(contact: &SpaceContact, radius: f64, friction: f64) -> Settings {
    Settings {
        radius,
        material: Material { young: contact.modulus, poisson: contact.poisson },
        hertz_constant: contact.hertz_constant,
        kalker: None,
        friction,
        creep: match contact.creep {
            CreepName::Linear => Creep::Linear,
            CreepName::Shen => Creep::Shen,
            CreepName::Fastsim => Creep::Fastsim,
            CreepName::None => Creep::None,
        },
    }
}
