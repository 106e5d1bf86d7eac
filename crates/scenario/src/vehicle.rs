//! Equations of a vehicle of bodies, wheels and links, by the energy of its links.
//!
//! ```text
//! q = [z, θ of every body as it moves; z of every wheel with mass],   z down, θ > 0 lowers the front
//! w(x) = z + θ (x_g − x)                        a body at x m behind the vehicle's front end
//! K = Σ k v vᵀ,  C = Σ c v vᵀ                   vᵀ q = w_a(x) − w_b(x) of a link; of a wheel w = z
//! P_i = g m_i + L_i − (K_wb K_bb⁻¹ g m_b)_i     static load of wheel i, all wheels held
//! ```

use ttb_contract::GRAVITY;

use crate::types::{Body, BodyFreedom, Car, Vehicle};

/// A pivot below this part of the largest stiffness at its freedom is none: rounding of the assembly.
const SINGULAR: f64 = 1e-12;

/// Matrices of a vehicle, by rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Equations {
    /// Names of the degrees of freedom, such as `bogie pitch`.
    pub freedoms: Vec<String>,
    /// Degrees of freedom of every body: bounce, pitch.
    pub bodies: Vec<[Option<usize>; 2]>,
    /// Degree of freedom of every wheel; `None`: a force alone.
    pub wheels: Vec<Option<usize>>,
    /// Diagonal of M.
    pub mass: Vec<f64>,
    /// C.
    pub damping: Vec<f64>,
    /// K; singular, wheels are free.
    pub stiffness: Vec<f64>,
    /// Weights, and loads of wheels that have a mass, N.
    pub weight: Vec<f64>,
    /// Static load of every wheel, N.
    pub loads: Vec<f64>,
}

/// What a vehicle cannot be built from: where in it, which rule, what was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Path inside the vehicle, such as `.links[3].between`.
    pub path: String,
    /// What must hold.
    pub rule: &'static str,
    /// What was found.
    pub found: String,
}

impl Equations {
    /// Of a vehicle.
    ///
    /// # Errors
    /// Everything that it cannot be built from.
    pub fn new(vehicle: &Vehicle) -> Result<Self, Vec<Fault>> {
        let mut faults = faults(vehicle);
        let (mut freedoms, mut mass, mut bodies, mut weight) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for body in &vehicle.bodies {
            let moves = moves(body);
            let mut add = |there: bool, word: &str, m: f64, w: f64| {
                there.then(|| {
                    freedoms.push(format!("{} {word}", body.name));
                    mass.push(m);
                    weight.push(w);
                    mass.len() - 1
                })
            };
            bodies.push([
                add(moves[0], "bounce", body.mass, GRAVITY * body.mass),
                add(moves[1], "pitch", body.inertia, 0.0),
            ]);
        }
        let held = mass.len();
        let mut wheels = Vec::new();
        for (i, wheel) in vehicle.wheels.iter().enumerate() {
            let name = format!("wheel{}", i + 1);
            let linked = vehicle.links.iter().any(|link| link.between.contains(&name));
            wheels.push((wheel.mass > 0.0 || linked).then(|| {
                freedoms.push(name);
                mass.push(wheel.mass);
                weight.push(GRAVITY * wheel.mass + wheel.load);
                mass.len() - 1
            }));
        }
        let n = mass.len();
        let (mut stiffness, mut damping) = (vec![0.0; n * n], vec![0.0; n * n]);
        for link in &vehicle.links {
            let Some((row, _)) = row(vehicle, &bodies, &wheels, link) else { continue };
            for (i, a) in &row {
                for (j, b) in &row {
                    stiffness[i * n + j] += link.stiffness * a * b;
                    damping[i * n + j] += link.damping * a * b;
                }
            }
        }
        let loads = match held_by_wheels(&stiffness, n, held, &weight) {
            Ok(q) => {
                let load = |(wheel, dof): (&crate::types::Wheel, &Option<usize>)| match dof {
                    None => wheel.load,
                    Some(i) => weight[*i] - (0..held).map(|j| stiffness[i * n + j] * q[j]).sum::<f64>(),
                };
                vehicle.wheels.iter().zip(&wheels).map(load).collect::<Vec<_>>()
            }
            Err(dof) => {
                let rule = "every motion of a body must be held by links that lead to a wheel";
                faults.push(Fault { path: ".links".into(), rule, found: format!("{} is not held", freedoms[dof]) });
                Vec::new()
            }
        };
        for (i, load) in loads.iter().enumerate().filter(|(_, load)| **load <= 0.0 || load.is_nan()) {
            let rule = "every wheel must carry a load at rest";
            faults.push(Fault { path: format!(".wheels[{i}]"), rule, found: format!("{load:.1} N") });
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        Ok(Self { freedoms, bodies, wheels, mass, damping, stiffness, weight, loads })
    }
}

/// Whether a body bounces and pitches.
fn moves(body: &Body) -> [bool; 2] {
    match &body.freedoms {
        None => [true, body.inertia > 0.0],
        Some(listed) => [BodyFreedom::Bounce, BodyFreedom::Pitch].map(|freedom| listed.contains(&freedom)),
    }
}

/// v of a link and its place; `None` if it joins what is not there.
fn row(
    vehicle: &Vehicle,
    bodies: &[[Option<usize>; 2]],
    wheels: &[Option<usize>],
    link: &crate::types::Link,
) -> Option<(Vec<(usize, f64)>, f64)> {
    let body = |name: &String| vehicle.bodies.iter().position(|body| body.name == *name);
    let wheel = |name: &String| {
        let number: usize = name.strip_prefix("wheel")?.parse().ok()?;
        (number >= 1 && number <= wheels.len()).then(|| number - 1)
    };
    let place =
        |name: &String| body(name).map(|b| vehicle.bodies[b].x).or_else(|| Some(vehicle.wheels[wheel(name)?].x));
    let over_wheel = link.between.iter().find_map(|name| Some(vehicle.wheels[wheel(name)?].x));
    let x = link.x.or(over_wheel).or_else(|| place(&link.between[1]))?;
    let mut row = Vec::new();
    for (name, sign) in link.between.iter().zip([1.0, -1.0]) {
        if let Some(b) = body(name) {
            let arm = vehicle.bodies[b].x - x;
            row.extend(bodies[b][0].map(|dof| (dof, sign)));
            row.extend(bodies[b][1].map(|dof| (dof, sign * arm)));
        } else {
            row.extend(wheels[wheel(name)?].map(|dof| (dof, sign)));
        }
    }
    Some((row, x))
}

/// What is wrong with the parts alone.
fn faults(vehicle: &Vehicle) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut fault = |path: String, rule: &'static str, found: String| faults.push(Fault { path, rule, found });
    let names: Vec<&str> = vehicle.bodies.iter().map(|body| body.name.as_str()).collect();
    let is_wheel = |name: &str| {
        let number = name.strip_prefix("wheel").and_then(|number| number.parse::<usize>().ok());
        number.filter(|number| (1..=vehicle.wheels.len()).contains(number))
    };
    for (i, body) in vehicle.bodies.iter().enumerate() {
        let path = format!(".bodies[{i}]");
        if names[..i].contains(&body.name.as_str()) {
            fault(format!("{path}.name"), "names of bodies must differ", format!("`{}`", body.name));
        }
        if body.name.strip_prefix("wheel").is_some_and(|rest| rest.parse::<usize>().is_ok()) {
            fault(format!("{path}.name"), "a body must not have the name of a wheel", format!("`{}`", body.name));
        }
        if moves(body)[1] && body.inertia <= 0.0 {
            fault(format!("{path}.inertia"), "a body that pitches needs an inertia above 0", body.inertia.to_string());
        }
        if !(0.0..=vehicle.length()).contains(&body.x) {
            let found = format!("{} m, the vehicle is {} m long", body.x, vehicle.length());
            fault(format!("{path}.x"), "a body must lie within its vehicle", found);
        }
    }
    for (i, wheel) in vehicle.wheels.iter().enumerate() {
        let path = format!(".wheels[{i}]");
        if !(0.0..=vehicle.length()).contains(&wheel.x) {
            let found = format!("{} m, the vehicle is {} m long", wheel.x, vehicle.length());
            fault(format!("{path}.x"), "a wheel must lie within its vehicle", found);
        }
        if i > 0 && wheel.x <= vehicle.wheels[i - 1].x {
            let found = format!("{} m after {} m", wheel.x, vehicle.wheels[i - 1].x);
            fault(format!("{path}.x"), "wheels must be listed from the front backwards", found);
        }
        let name = format!("wheel{}", i + 1);
        if wheel.mass <= 0.0 && vehicle.links.iter().any(|link| link.between.contains(&name)) {
            fault(format!("{path}.mass"), "a wheel that carries a link needs a mass above 0", wheel.mass.to_string());
        }
    }
    for (i, link) in vehicle.links.iter().enumerate() {
        let path = format!(".links[{i}]");
        let known = |name: &String| names.contains(&name.as_str()) || is_wheel(name).is_some();
        for (k, name) in link.between.iter().enumerate().filter(|(_, name)| !known(name)) {
            let found = format!(
                "`{name}`; there are {}",
                names.iter().copied().chain(["wheel1 …"]).collect::<Vec<_>>().join(", ")
            );
            fault(format!("{path}.between[{k}]"), "must be a body or a wheel", found);
        }
        if link.between[0] == link.between[1] || link.between.iter().all(|name| is_wheel(name).is_some()) {
            let found = format!("{:?}", link.between);
            fault(format!("{path}.between"), "a link joins a body with another body or a wheel", found);
        }
        if link.x.is_some_and(|x| !(0.0..=vehicle.length()).contains(&x)) {
            let found = format!("{} m, the vehicle is {} m long", link.x.unwrap_or_default(), vehicle.length());
            fault(format!("{path}.x"), "a link must lie within its vehicle", found);
        }
    }
    faults
}

/// K_bb⁻¹ w_b of the first `held` freedoms by Cholesky's factors; the freedom that nothing holds is the error.
fn held_by_wheels(stiffness: &[f64], n: usize, held: usize, weight: &[f64]) -> Result<Vec<f64>, usize> {
    let mut l = vec![0.0; held * held];
    for i in 0..held {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| l[i * held + k] * l[j * held + k]).sum();
            let left = stiffness[i * n + j] - sum;
            if i == j {
                // A NaN is not held either.
                if left.is_nan() || left <= SINGULAR * stiffness[i * n + i] {
                    return Err(i);
                }
                l[i * held + i] = left.sqrt();
            } else {
                l[i * held + j] = left / l[j * held + j];
            }
        }
    }
    let mut q = weight[..held].to_vec();
    for i in 0..held {
        let sum: f64 = (0..i).map(|k| l[i * held + k] * q[k]).sum();
        q[i] = (q[i] - sum) / l[i * held + i];
    }
    for i in (0..held).rev() {
        let sum: f64 = (i + 1..held).map(|k| l[k * held + i] * q[k]).sum();
        q[i] = (q[i] - sum) / l[i * held + i];
    }
    Ok(q)
}

/// The car of 10 degrees of freedom as bodies, wheels and links.
#[must_use]
pub fn of_car(car: &Car) -> Vehicle {
    use crate::types::{Link, Wheel};
    let (centre, lc, lt) = (0.5 * car.length, 0.5 * car.bogie_distance, 0.5 * car.wheelbase);
    let body =
        |name: &str, mass: f64, inertia: f64, x: f64| Body { name: name.into(), mass, inertia, x, freedoms: None };
    let link = |a: &str, b: &str, stiffness: f64, damping: f64| Link {
        between: [a.into(), b.into()],
        x: None,
        stiffness,
        damping,
    };
    let bogies = [("front", centre - lc), ("rear", centre + lc)];
    let mut bodies = vec![body("body", car.body_mass, car.body_inertia, centre)];
    let (mut wheels, mut links) = (Vec::new(), Vec::new());
    for (name, x) in bogies {
        bodies.push(body(name, car.bogie_mass, car.bogie_inertia, x));
        links.push(link("body", name, car.secondary_stiffness, car.secondary_damping));
        for arm in [-lt, lt] {
            wheels.push(Wheel { x: x + arm, mass: car.wheelset_mass, load: 0.0 });
            links.push(link(name, &format!("wheel{}", wheels.len()), car.primary_stiffness, car.primary_damping));
        }
    }
    Vehicle { name: car.name.clone(), wheels, bodies, links, length: Some(car.length), source: car.source.clone() }
}
