//! Requests that cannot be, whatever the scenario.

use crate::request::{Choice, Headings, Request};

/// What a request asks for that an FMU in the place of the bridge cannot do, each with what to do instead, beginning with the key.
#[must_use]
pub fn over_fmu(request: &Request) -> Vec<String> {
    // What is wrong with the list itself is told elsewhere.
    let variants = request.variants.list().unwrap_or_default();
    let mut problems = Vec::new();
    let mut add = |is: bool, text: &str| problems.extend(is.then(|| text.to_string()));
    add(
        matches!(request.way, Choice::Modal | Choice::OneAxle),
        "way: modes and influence lines of an FMU are not known: leave --way out, or take coupled",
    );
    add(request.forces, "forces: an FMU tells no moments, shears and reactions: leave --forces out");
    add(
        request.heading != Headings::Forward,
        "heading: the places of an FMU count from the bridge's begin: for trains from the other end give a map in which they \
         count from there, in a sweep of its own",
    );
    add(
        variants.iter().any(|one| one.mass_factor != 1.0 || one.stiffness_factor != 1.0),
        "variants: mass and stiffness of an FMU are its own: give its parameters other values, in the map or, with ttb \
         campaign, as the axis fmus.bridge.parameters.NAME",
    );
    let own = ["bridge.structure", "bridge.damping", "bridge.modes", "bridge.reduction"];
    let set = variants.iter().flat_map(|one| &one.set).map(|(key, _)| key).chain(request.axes.keys());
    if let Some(key) = set.into_iter().find(|key| own.iter().any(|of| key.starts_with(of))) {
        problems
            .push(format!("axes: {key} changes the scenario's bridge, in whose place the FMU stands: leave it out"));
    }
    problems
}
