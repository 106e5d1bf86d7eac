//! The key `space`: from what a scenario says to what the physics in space is built from, with every problem on the way.

mod car;
mod irregularity;
mod loads;
mod track;

use std::path::Path;

use ttb_import::{Columns, Input, series};

use crate::bundled;
use crate::pieces::Pieces;
use crate::problem::Report;
use crate::spec::{Profile, SpaceContact, SpaceSpec, Vehicle};
use crate::types::{
    CarChoice, Contact, ContactInSpace, ContactLaw, Forces, ProfileShape, RailProfile, Space, TrackType, WheelProfile,
};

pub(crate) use irregularity::sigma_of;

/// What was chosen, and what is built from it.
pub(crate) struct Spatial {
    /// With every default written in.
    pub filled: Space,
    pub spec: SpaceSpec,
    /// A measured level, which takes the place of the plane key.
    pub level: Option<Profile>,
}

/// Reads the key, if it is there.
pub(crate) fn resolve(
    pieces: &Pieces,
    track: Option<&TrackType>,
    base_dir: &Path,
    report: &mut Report,
) -> Option<Spatial> {
    if !pieces.has_space {
        return None;
    }
    let radius = pieces.contact.as_ref().map_or(Contact::default().wheel_radius, |contact| contact.wheel_radius);
    let cars = cars(pieces, radius, report);
    if let Some(contact) = &pieces.contact {
        plane_contact(contact, report);
    }
    let space = pieces.space.as_ref()?;
    let mut filled = space.clone();
    let contact = contact(&space.contact, report);
    let track = track.and_then(|track| track::resolve(&space.track, track, report));
    let level = pieces.irregularity.as_ref();
    let chosen = irregularity::chosen(space.irregularity.as_ref(), level);
    let components = irregularity::resolve(&chosen, level, base_dir, report);
    filled.irregularity = Some(chosen);
    let curve = space.curve.as_ref().map_or_else(|| Some(Vec::new()), |curve| loads::curve(curve, report));
    let wind = space.wind.as_ref().map(|wind| loads::wind(wind, base_dir, report));
    let ground = space.ground_motion.as_ref().map(|ground| loads::ground(ground, base_dir, report));
    let (track, track_filled) = track?;
    filled.track = track_filled;
    let (irregularity, level) = components?;
    let spec = SpaceSpec {
        cars: cars?,
        track,
        contact: contact?,
        irregularity,
        curve: curve?,
        wind: wind.map_or(Some(None), |wind| wind.map(Some))?,
        ground: ground.map_or(Some(None), |ground| ground.map(Some))?,
    };
    Some(Spatial { filled, spec, level })
}

/// The cars' data in space; vehicles that have none are refused.
fn cars(pieces: &Pieces, radius: f64, report: &mut Report) -> Option<Vec<crate::spec::SpaceCar>> {
    let known = || bundled::files(bundled::Kind::Cars).iter().filter(|(_, text)| text.contains("\"space\""));
    let names = || known().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    if let Some(Forces::Axles(_) | Forces::Named(_)) = &pieces.forces {
        report.problem("$.train.forces", "a run in space needs cars: forces alone have no lateral motion", "forces");
        return None;
    }
    let mut all = Some(Vec::new());
    for (i, choice) in pieces.cars.iter().enumerate() {
        let path = format!("$.train.cars[{i}]");
        let cars = match choice {
            Some(CarChoice::Bundled(name)) => bundled::cars(name).unwrap_or_default(),
            Some(CarChoice::Data(car)) => vec![(**car).clone()],
            Some(CarChoice::Vehicle(_)) => {
                let rule = "a run in space needs cars with a key `space`: vehicles of bodies and links are plane";
                report.problem(&path, rule, "bodies and links");
                Vec::new()
            }
            None => Vec::new(),
        };
        let bundled = matches!(choice, Some(CarChoice::Bundled(_)));
        if cars.is_empty() {
            all = None;
        }
        for car in cars {
            let Some(space) = &car.space else {
                let rule = "a run in space needs a car's data in space";
                let found = if let Some(CarChoice::Bundled(name)) = choice {
                    format!("`{name}` has none; bundled cars with them: {}", names())
                } else {
                    format!("the car has no key `space`; bundled cars with one: {}", names())
                };
                report.problem(&path, rule, found);
                all = None;
                break;
            };
            let path = (!bundled).then(|| format!("{path}.space"));
            let built = car::resolve(&car, space, radius, path.as_deref(), report);
            all = all.zip(built).map(|(mut all, car)| {
                all.push(car);
                all
            });
        }
    }
    all.filter(|all| !all.is_empty())
}

/// Plane keys of the contact that a run in space does not use.
fn plane_contact(contact: &Contact, report: &mut Report) {
    if contact.law != ContactLaw::Hertz {
        report.problem("$.contact.law", "must be hertz in space", "linear");
    }
    if contact.wheels_per_axle != 2 {
        report.problem("$.contact.wheels_per_axle", "must be 2 in space", contact.wheels_per_axle);
    }
    if let Some(constant) = contact.hertz_constant {
        let rule = "is not used in space: give space.contact.hertz_constant";
        report.problem("$.contact.hertz_constant", rule, format!("{constant:e}"));
    }
}

fn contact(contact: &ContactInSpace, report: &mut Report) -> Option<SpaceContact> {
    let base = "$.space.contact";
    let wheel = match &contact.wheel {
        WheelProfile::Named(name) => bundled::wheel_profile(name),
        WheelProfile::Points(points) => measured(&points.points_mm, &format!("{base}.wheel"), report),
    };
    let rail = match &contact.rail {
        RailProfile::Named(name) => bundled::rail_profile(name),
        RailProfile::Points(points) => measured(&points.points_mm, &format!("{base}.rail"), report),
    };
    if contact.taping_line <= 0.5 * contact.back_to_back {
        let rule = "the taping line must lie outside the wheels' inner faces: taping_line > back_to_back/2";
        let found = format!("{} ≤ {} m", contact.taping_line, 0.5 * contact.back_to_back);
        report.problem(format!("{base}.taping_line"), rule, found);
    }
    Some(SpaceContact {
        wheel: wheel?,
        rail: rail?,
        back_to_back: contact.back_to_back,
        taping_line: contact.taping_line,
        friction: contact.friction,
        creep: contact.creep,
        softness: contact.softness,
        hertz_constant: contact.hertz_constant,
        modulus: contact.modulus,
        poisson: contact.poisson,
    })
}

/// A measured profile, its first coordinate rising.
fn measured(points: &[[f64; 2]], path: &str, report: &mut Report) -> Option<ProfileShape> {
    if let Some(i) = points.windows(2).position(|pair| pair[1][0] <= pair[0][0]) {
        let found = format!("{} mm after {} mm", points[i + 1][0], points[i][0]);
        report.problem(format!("{path}.points_mm[{}][0]", i + 1), "must increase", found);
        return None;
    }
    Some(ProfileShape::PointsMm(points.to_vec()))
}

/// Columns of a file, or what is wrong with it at `path`.
fn columns(
    file: &str,
    base_dir: &Path,
    [needed, also]: [&[&str]; 2],
    path: &str,
    report: &mut Report,
) -> Option<Columns> {
    let file = base_dir.join(file);
    match series(&Input::path(&file), needed, also) {
        Ok(columns) => Some(columns),
        Err(problems) => {
            for problem in problems.0 {
                let line = problem.line.map_or_else(String::new, |line| format!(": line {line}"));
                let value = if problem.value.is_empty() { String::new() } else { format!(": {}", problem.value) };
                report.problem(path, problem.rule, format!("{}{line}{value}", file.display()));
            }
            None
        }
    }
}

/// Vehicles as the plane model takes them: without what they have in space.
pub(crate) fn plane(vehicles: Vec<Vehicle>) -> Vec<Vehicle> {
    let strip = |vehicle| match vehicle {
        Vehicle::Car(car) => Vehicle::Car(crate::types::Car { space: None, ..car }),
        bodies @ Vehicle::Bodies(_) => bodies,
    };
    vehicles.into_iter().map(strip).collect()
}
