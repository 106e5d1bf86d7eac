//! documentation/index.html of an FMU: what it is and every variable with its unit.

use crate::about::About;
use quick_xml::escape::escape;
use std::fmt::Write;
use ttb_contract::{Causality, Interface, Kind, Variable};

const STYLE: &str = "body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em}\
    table{border-collapse:collapse}td,th{border:1px solid #bbb;padding:.2em .6em;text-align:left}code{font-size:.95em}";

const CONVENTIONS: &str = "<ul>
<li>SI units. z and all displacements, velocities and forces along it point downwards; \
a positive <code>force</code> presses the bridge down.</li>
<li>An input set before <code>fmi2DoStep</code> is its value at the beginning of the step; with its first derivative set \
(<code>fmi2SetRealInputDerivatives</code>, order 1) it runs along a straight line over the step, without derivative it is held.</li>
<li>A step begins where the last one has ended; <code>fmi2DoStep</code> at another time is refused.</li>
<li>Outputs after <code>fmi2DoStep</code> are those at the end of the step; in initialization mode those of static equilibrium.</li>
<li>Forces and motions are changes from the state under dead load.</li>
<li>FMU states can be saved, restored and serialized; a step repeated after a restore gives the same bits.</li>
<li>Any positive step size works; the step of the default experiment is prepared and is the fastest.</li>
</ul>";

/// The text of the page, HTML.
pub fn documentation(interface: &Interface, about: &About) -> String {
    let name = escape(about.model_name);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>{name}</title><style>{STYLE}</style></head>\n\
         <body>\n<h1>{name}</h1>\n<p>{}</p>\n<p>FMI 2.0 for co-simulation; model identifier <code>{}</code>; step {} s, stop time {} s; \
         made by ttb {}.</p>\n<h2>Conventions</h2>\n{CONVENTIONS}\n",
        escape(about.full_description()),
        escape(about.model_identifier),
        about.step,
        about.stop,
        env!("CARGO_PKG_VERSION"),
    );
    let groups = [
        ("Inputs", Causality::Input, "Start"),
        ("Outputs", Causality::Output, "Start"),
        ("Parameters", Causality::Parameter, "Default"),
    ];
    for (title, causality, start) in groups {
        let group: Vec<_> =
            interface.variables().iter().enumerate().filter(|(_, v)| v.causality == causality).collect();
        let _ = write!(
            page,
            "<h2>{title} ({})</h2>\n<table>\n<tr><th>Name</th><th>Unit or type</th><th>{start}</th><th>Meaning</th>\
             <th>Value reference</th></tr>\n",
            group.len()
        );
        group.into_iter().for_each(|(reference, v)| page += &row(reference, v));
        page += "</table>\n";
    }
    page + "</body>\n</html>\n"
}

fn row(reference: usize, v: &Variable) -> String {
    let (kind, start) = match &v.kind {
        Kind::Real { unit } => (unit.to_string(), format!("{:?}", v.start)),
        Kind::Boolean => ("Boolean".to_string(), (v.start != 0.0).to_string()),
        Kind::Integer { min, max } => (format!("Integer {min} \u{2026} {max}"), format!("{:.0}", v.start)),
        Kind::Enumeration(items) => {
            let items = items.iter().enumerate().map(|(i, (name, text))| format!("{} = {name} ({text})", i + 1));
            (items.collect::<Vec<_>>().join("; "), format!("{:.0}", v.start))
        }
    };
    let (name, text) = (escape(&v.name), escape(&v.description));
    format!(
        "<tr><td><code>{name}</code></td><td>{}</td><td>{start}</td><td>{text}</td><td>{reference}</td></tr>\n",
        escape(kind)
    )
}
