//! `ttb inspect`: what an FMU offers, and how it might be mapped onto a bridge of ours. No code of the FMU is run.

use ttb_fmi::FmuError;
use ttb_fmi::archive::unpack;
use ttb_fmi::description::{ModelDescription, Unit, VariableType};
use ttb_fmi::library::platforms;
use ttb_fmi2::import::read_description;

use crate::cli::Inspect;
use crate::connect::map::{INDEX, Map, Series};
use crate::connect::series::{Found, series};
use crate::error::Error;
use crate::printed::one_line;

/// Powers of kg, m, s of what is looked for.
const FORCE: [i32; 3] = [1, 1, -2];
const LENGTH: [i32; 3] = [0, 1, 0];
const VELOCITY: [i32; 3] = [0, 1, -1];

/// Parts of names, lower case, that speak for a force, a displacement, a velocity.
const FORCE_WORDS: &[&str] = &["force", "load", "fz", "f_z", "f"];
const LENGTH_WORDS: &[&str] = &["displacement", "deflection", "disp", "uz", "u_z", "sag", "w", "u", "z", "y"];
const VELOCITY_WORDS: &[&str] = &["velocity", "vel", "vz", "v_z", "speed", "rate", "v"];

/// The command.
pub fn inspect(arguments: &Inspect) -> Result<(), Error> {
    let fmu = || arguments.fmu.clone();
    std::fs::File::open(&arguments.fmu).map_err(|e| Error::Input(format!("{}: {e}", arguments.fmu.display())))?;
    let folder = unpack(&arguments.fmu).map_err(|source| FmuError::Unpack { fmu: fmu(), source })?;
    let xml = std::fs::read(folder.path().join("modelDescription.xml"));
    let description = xml.map_err(Into::into).and_then(|xml| read_description(&xml));
    let description = description.map_err(|source| FmuError::Description { fmu: fmu(), source })?;
    let map = propose(&description);
    let text = |map: &Map| serde_json::to_string_pretty(map).map_err(|e| Error::Pack(e.to_string()));
    if arguments.map {
        let none =
            || Error::Input(format!("{}: no map can be proposed; ttb inspect lists its variables", fmu().display()));
        say!("{}", text(&map.ok_or_else(none)?)?);
        return Ok(());
    }
    show(&description, &platforms(folder.path()));
    match map {
        Some(map) => say!("\nproposed map as a bridge (check signs: down is positive here):\n{}", text(&map)?),
        None => say!("\nno map as a bridge can be proposed: no inputs like forces with outputs like displacements"),
    }
    Ok(())
}

fn show(d: &ModelDescription, platforms: &str) {
    let tool = if d.generation_tool.is_empty() { "not said" } else { &d.generation_tool };
    let c = &d.co_simulation;
    let flags = [
        ("rolls back", c.can_get_and_set_state),
        ("serializes states", c.can_serialize_state),
        ("interpolates inputs", c.can_interpolate_inputs),
        ("directional derivatives", c.provides_directional_derivative),
        ("variable steps", c.can_handle_variable_communication_step_size),
    ];
    let list = |wanted| {
        let names: Vec<_> = flags.iter().filter(|(_, on)| *on == wanted).map(|(name, _)| *name).collect();
        if names.is_empty() { "–".to_string() } else { names.join(", ") }
    };
    let number = |x: Option<f64>| x.map_or("?".into(), |x| format!("{x}"));
    say!("model      {} (FMI {}, GUID {})", one_line(&d.model_name), d.fmi_version, one_line(&d.guid));
    say!("tool       {}", one_line(tool));
    say!("platforms  {platforms}");
    say!("can        {}", list(true));
    say!("cannot     {}", list(false));
    if c.can_be_instantiated_only_once_per_process {
        say!("limit      one instance a process");
    }
    if c.needs_execution_tool {
        say!("limit      needs its tool at run time");
    }
    let (start, stop, step) = (number(d.start_time), number(d.stop_time), number(d.step_size));
    say!("experiment from {start} to {stop} s by {step} s");
    for causality in ["input", "output", "parameter"] {
        for found in series(d, causality) {
            let unit = found.example.unit.as_deref().unwrap_or("–");
            let kind = match found.example.kind {
                VariableType::Real => String::new(),
                other => format!("  {other:?}"),
            };
            say!("{:<44} {:>6}  {causality:<9}  {unit}{kind}", found.label(), found.count());
        }
    }
}

/// The map that names, units and numbers suggest.
pub fn propose(d: &ModelDescription) -> Option<Map> {
    let (inputs, outputs) = (series(d, "input"), series(d, "output"));
    let force = best(d, &inputs, FORCE, FORCE_WORDS, None)?;
    let displacement = best(d, &outputs, LENGTH, LENGTH_WORDS, Some(force))?;
    let others: Vec<Found> = outputs.iter().filter(|s| s.pattern != displacement.pattern).cloned().collect();
    let velocity =
        best(d, &others, VELOCITY, VELOCITY_WORDS, Some(force)).filter(|s| s.count() == displacement.count());
    Some(Map {
        force: entry(d, force),
        displacement: entry(d, displacement),
        velocity: velocity.map(|found| entry(d, found)),
        ..Map::default()
    })
}

/// The series that fits best; with as many members as `partner`, if that is given.
fn best<'a, 'd>(
    d: &ModelDescription,
    all: &'a [Found<'d>],
    powers: [i32; 3],
    words: &[&str],
    partner: Option<&Found>,
) -> Option<&'a Found<'d>> {
    let fits = |found: &&Found| {
        found.example.kind == VariableType::Real
            && !found.numbers.is_empty()
            && found.gapless()
            && partner.is_none_or(|partner| partner.count() == found.count())
            && score(d, found, powers, words) > 0
    };
    // The first of equals: the order of the file is the author's.
    let key = |found: &&Found| (score(d, found, powers, words), found.count());
    all.iter().filter(fits).rev().max_by_key(|found| key(found))
}

/// 100 for the right unit, nothing for a wrong one, and up to 50 for a word of the list, the first words before the last.
fn score(d: &ModelDescription, found: &Found, powers: [i32; 3], words: &[&str]) -> usize {
    let by_unit = match unit(d, found) {
        Some(unit) if unit.powers[..3] == powers && unit.powers[3..].iter().all(|p| *p == 0) => 100,
        Some(_) => return 0,
        None => 0,
    };
    let pattern = found.pattern.replace(INDEX, " ").to_lowercase();
    let parts: Vec<&str> = pattern.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').collect();
    let hit = |word: &&&str| match word.len() {
        1 => parts.iter().any(|part| part.trim_matches('_') == **word),
        _ => pattern.contains(**word),
    };
    let by_word = words.iter().position(|word| hit(&word)).map_or(0, |place| 50 - place);
    by_unit + by_word
}

fn unit<'d>(d: &'d ModelDescription, found: &Found) -> Option<&'d Unit> {
    d.units.get(found.example.unit.as_ref()?)
}

/// A series as an entry of the map: the factor from its unit, the sign from what its description says.
fn entry(d: &ModelDescription, found: &Found) -> Series {
    let says = format!("{} {}", found.pattern, found.example.description).to_lowercase();
    let up = ["upward", "positive up", "up positive", "up-positive", "up is positive"].iter().any(|w| says.contains(w));
    let factor = unit(d, found).map_or(1.0, |unit| 1.0 / unit.factor);
    // 1/1000 and the like come out as written, not as 9.999999999999999e-4.
    let factor = format!("{factor:.12e}").parse().unwrap_or(factor);
    let first = found.numbers.first().copied().unwrap_or(1);
    let factor = Some(if up { -factor } else { factor });
    Series { name: Some(found.pattern.clone()), first: Some(first), factor, ..Series::default() }
}
