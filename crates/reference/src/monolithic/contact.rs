//! Contacts of the plain solver: the law in series with the rail's local compliance, and the rail's profile.

use std::f64::consts::{PI, TAU};

use ttb_scenario::spec::{Profile, TrainTrackSpec};
use ttb_scenario::types::{ContactLaw, RampShape, Tread};

/// r(x) of a smooth or wavy rail, m.
///
/// # Errors
/// Another profile.
pub fn roughness(profile: &Profile, x: f64) -> Result<f64, String> {
    let Profile::Waves { waves, origin, ramp } = profile else {
        return if *profile == Profile::None { Ok(0.0) } else { Err("the reference solver knows waves only".into()) };
    };
    let grown = ramp.as_ref().map_or(1.0, |ramp| {
        let s = ((x - ramp.start) / ramp.length).clamp(0.0, 1.0);
        match ramp.shape {
            RampShape::Cosine => 0.5 * (1.0 - (PI * s).cos()),
            RampShape::Quintic => s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s),
        }
    });
    Ok(grown * waves.iter().map(|w| w.amplitude * (TAU * (x - origin) / w.wavelength + w.phase).sin()).sum::<f64>())
}

/// F(s) and F′(s) of the contact in series with c_loc, by scalar Newton from the stiff side.
pub fn contact(spec: &TrainTrackSpec, load: f64, compliance: f64, s: f64) -> (f64, f64) {
    let (contact, r) = (&spec.contact, spec.contact.wheel_radius);
    let wheels = f64::from(contact.wheels_per_axle);
    let g = contact.hertz_constant.unwrap_or(match contact.tread {
        Tread::Worn => 3.86e-8 * r.powf(-0.115),
        Tread::Conical => 4.57e-8 * r.powf(-0.149),
    });
    let law = |delta: f64| match contact.law {
        ContactLaw::Hertz if delta > 0.0 => (wheels * (delta / g).powf(1.5), 1.5 * wheels * (delta / g).sqrt() / g),
        ContactLaw::Hertz => (0.0, 0.0),
        ContactLaw::Linear => {
            let (p, k) = (load / wheels, 1.5 * (load / wheels).cbrt() / g);
            let force = wheels * (p + k * (delta - g * p.powf(2.0 / 3.0)));
            if force > 0.0 { (force, wheels * k) } else { (0.0, 0.0) }
        }
    };
    let mut delta = s;
    for _ in 0..60 {
        let (force, slope) = law(delta);
        delta -= (delta + compliance * force - s) / (1.0 + compliance * slope);
    }
    let (force, slope) = law(delta);
    (force, slope / (1.0 + compliance * slope))
}

/// s under the static load, by bisection.
pub fn static_approach(spec: &TrainTrackSpec, load: f64, compliance: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1e-2);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if contact(spec, load, compliance, middle).0 < load { low = middle } else { high = middle }
    }
    low
}
