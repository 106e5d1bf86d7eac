//! The annotation `org.ttb.coupling`: what SSP has no place for. Attributes that are absent have defaults.
//!
//! Settings of the iteration have the names, values and defaults they have in a scenario's section `coupling`, and are
//! checked by its schema: nothing is listed here twice.

use serde_json::{Map, Value, json};
use ttb_scenario::types::{CouplingSettings, Output};
use ttb_ssp::{Annotation, Report};

/// Type of the annotation.
pub const KIND: &str = "org.ttb.coupling";
/// Type of the annotation of libcosim, and its elements.
const OSP: &str = "com.opensimulationplatform";
const OSP_FIXED_STEP: [&str; 2] = ["Algorithm", "FixedStepAlgorithm"];
/// Type of the annotation of OMSimulator, and its elements.
const OPEN_MODELICA: &str = "org.openmodelica";
const OPEN_MODELICA_FIXED_STEP: [&str; 3] = ["Annotations", "SimulationInformation", "FixedStepMaster"];
/// N; some axle loads of a train: the scale of the tolerance where none is given.
const FORCE_SCALE: f64 = 100e3;

/// What the annotation says.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Macro step, s.
    pub step: Option<f64>,
    /// Internal steps of the train–track FMU in each; more than one: its mean forces are coupled.
    pub substeps: usize,
    /// Scale of the tolerance, N.
    pub force_scale: f64,
    /// The component that sends forces.
    pub train_track: Option<String>,
    /// Results.
    pub output: Output,
    /// Between which times peaks count, s; `None`: always.
    pub peaks: Option<[f64; 2]>,
    /// The iteration.
    pub coupling: CouplingSettings,
    /// Where the annotation stands in the document.
    pub place: String,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            step: None,
            substeps: 1,
            force_scale: FORCE_SCALE,
            train_track: None,
            output: Output::default(),
            peaks: None,
            coupling: CouplingSettings::default(),
            place: String::new(),
        }
    }
}

/// The annotation of settings, and that of libcosim for the same step.
pub fn write(settings: &Settings) -> Vec<Annotation> {
    let mut attributes = Vec::new();
    attributes.extend(settings.train_track.iter().map(|name| ("train_track".to_string(), name.clone())));
    attributes.extend(settings.step.map(|step| ("step".to_string(), format!("{step:?}"))));
    if settings.substeps > 1 {
        attributes.push(("substeps".into(), settings.substeps.to_string()));
    }
    attributes.push(("force_scale".into(), format!("{:?}", settings.force_scale)));
    if let Ok(Value::Object(coupling)) = serde_json::to_value(settings.coupling) {
        attributes.extend(coupling.into_iter().map(|(key, value)| (key, text(&value))));
    }
    attributes.push(("output_every".into(), settings.output.every.to_string()));
    attributes.push(("output_supports".into(), settings.output.supports.to_string()));
    for (key, time) in ["peaks_from", "peaks_until"].iter().zip(settings.peaks.iter().flatten()) {
        attributes.push((key.to_string(), format!("{time:?}")));
    }
    let ours = Annotation {
        kind: KIND.into(),
        prefix: "ttb".into(),
        namespace: "urn:ttb:coupling".into(),
        elements: vec!["Coupling".into()],
        attributes,
        place: String::new(),
    };
    let osp = settings.step.map(|step| Annotation {
        kind: OSP.into(),
        prefix: "osp".into(),
        namespace: "http://opensimulationplatform.com/SSP/OSPAnnotations".into(),
        elements: OSP_FIXED_STEP.map(str::to_string).to_vec(),
        attributes: vec![("baseStepSize".into(), format!("{step:?}"))],
        place: String::new(),
    });
    std::iter::once(ours).chain(osp).collect()
}

fn text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_string)
}

/// Reads the settings from all annotations of a structure; what is wrong is reported, and everything else read.
pub fn read(annotations: &[Annotation], report: &mut Report) -> Settings {
    let mut settings = Settings::default();
    let mut ours = annotations.iter().filter(|annotation| annotation.kind == KIND);
    if let Some(annotation) = ours.next() {
        settings.place.clone_from(&annotation.place);
        let mut coupling = Map::new();
        for (key, text) in &annotation.attributes {
            let place = format!("{}/@{key}", annotation.place);
            if let Err(why) = set(&mut settings, &mut coupling, key, text) {
                report.problem(&place, why);
            }
        }
        // Every single setting fitted; so do they all.
        match serde_json::from_value(Value::Object(coupling)) {
            Ok(coupling) => settings.coupling = coupling,
            Err(error) => report.problem(&annotation.place, error.to_string()),
        }
    }
    if let Some(second) = ours.next() {
        report.problem(&second.place, format!("there is another annotation {KIND}"));
    }
    if settings.step.is_none() {
        settings.step = annotations.iter().find_map(step_of_others);
    }
    settings
}

/// The step that libcosim or OMSimulator would take.
fn step_of_others(annotation: &Annotation) -> Option<f64> {
    let key = match annotation.kind.as_str() {
        OSP if annotation.elements == OSP_FIXED_STEP => "baseStepSize",
        OPEN_MODELICA if annotation.elements == OPEN_MODELICA_FIXED_STEP => "stepSize",
        _ => return None,
    };
    let (_, step) = annotation.attributes.iter().find(|(known, _)| known == key)?;
    step.trim().parse().ok().filter(|step: &f64| *step > 0.0 && step.is_finite())
}

fn set(settings: &mut Settings, coupling: &mut Map<String, Value>, key: &str, text: &str) -> Result<(), String> {
    let positive = || {
        let value = text.trim().parse().ok().filter(|x: &f64| *x > 0.0 && x.is_finite());
        value.ok_or_else(|| format!("must be a positive number: {text:?}"))
    };
    let count = || {
        let count = text.trim().parse().ok().filter(|count| *count > 0);
        count.ok_or_else(|| format!("must be a whole number from 1: {text:?}"))
    };
    let time = || {
        let value = text.trim().parse().ok().filter(|x: &f64| *x >= 0.0 && x.is_finite());
        value.ok_or_else(|| format!("must be a time in s: {text:?}"))
    };
    match key {
        "peaks_from" => settings.peaks = Some([time()?, settings.peaks.map_or(f64::INFINITY, |[_, to]| to)]),
        "peaks_until" => settings.peaks = Some([settings.peaks.map_or(0.0, |[from, _]| from), time()?]),
        "train_track" => settings.train_track = Some(text.to_string()),
        "step" => settings.step = Some(positive()?),
        "force_scale" => settings.force_scale = positive()?,
        "substeps" => settings.substeps = count()?,
        "output_every" => settings.output.every = count()?,
        "output_supports" => {
            settings.output.supports = match text.trim() {
                "true" | "1" => true,
                "false" | "0" => false,
                _ => return Err(format!("must be true or false: {text:?}")),
            };
        }
        _ => drop(coupling.insert(key.to_string(), setting(key, text)?)),
    }
    Ok(())
}

/// A setting of the iteration as in a scenario, checked by its schema.
fn setting(key: &str, text: &str) -> Result<Value, String> {
    let schema = ttb_scenario::schema();
    let known = &schema["$defs"]["CouplingSettings"]["properties"];
    let Some(rule) = known.get(key) else {
        let own = [
            "train_track",
            "step",
            "substeps",
            "force_scale",
            "output_every",
            "output_supports",
            "peaks_from",
            "peaks_until",
        ];
        let names: Vec<&str> =
            known.as_object().into_iter().flat_map(Map::keys).map(String::as_str).chain(own).collect();
        return Err(format!("is no setting; there are {}", names.join(", ")));
    };
    let number =
        || serde_json::from_str(text.trim()).ok().filter(|value: &Value| value.is_number() || value.is_boolean());
    let value = number().unwrap_or_else(|| json!(text.trim()));
    let alone = Map::from_iter([(key.to_string(), value.clone())]);
    serde_json::from_value::<CouplingSettings>(Value::Object(alone)).map_err(|error| error.to_string())?;
    let bound = |name: &str| rule.get(name).and_then(Value::as_f64);
    let x = value.as_f64().unwrap_or(f64::NAN);
    let broken = [
        (bound("minimum").is_some_and(|least| x < least), "minimum"),
        (bound("exclusiveMinimum").is_some_and(|least| x <= least), "exclusiveMinimum"),
        (bound("maximum").is_some_and(|greatest| x > greatest), "maximum"),
    ];
    match broken.iter().find(|(broken, _)| *broken) {
        Some((_, name)) => Err(format!("is {text}, against the {name} {}", rule[*name])),
        None => Ok(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_come_back_bit_for_bit_and_every_wrong_one_is_found() {
        let mut settings = Settings { step: Some(0.1 + 0.2), train_track: Some("Zug".into()), ..Settings::default() };
        settings.coupling.tolerance = 1e-9 / 3.0;
        (settings.coupling.max_iterations, settings.output.supports, settings.substeps) = (7, true, 12);
        settings.peaks = Some([0.1, 2.0 / 3.0]);
        let written = write(&settings);
        let mut report = Report::new("a.ssp");
        assert_eq!(read(&written, &mut report), settings);
        assert!(report.is_empty());
        let step = read(&written[1..], &mut report);
        assert_eq!(step, Settings { step: settings.step, ..Settings::default() });

        let mut wrong = written[0].clone();
        wrong.attributes =
            [("step", "-1"), ("tolerance", "0"), ("method", "magic"), ("colour", "red"), ("max_iterations", "2.5")]
                .map(|(key, text)| (key.to_string(), text.to_string()))
                .to_vec();
        read(&[wrong, written[0].clone()], &mut report);
        let said = report.to_string();
        for place in ["/@step", "/@tolerance", "/@method", "/@colour", "/@max_iterations", "another annotation"] {
            assert!(said.contains(place), "{place}: {said}");
        }
    }
}
