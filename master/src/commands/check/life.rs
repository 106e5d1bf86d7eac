//! Loading, begin and end of an instance.

use ttb_fmi::file_uri;
use ttb_fmi2::probe::{Instantiation, ODDITIES, symbols as look_up};

use super::context::Context;
use super::drive::{Drive, confirmed, last, open, reference};
use super::finding::Finding;

/// Steps of a short run.
const FEW: usize = 10;

/// Functions of the library against the standard and against what the description promises.
pub fn symbols(context: &Context) -> Result<(), Finding> {
    context.announce()("loading the library");
    let capabilities = &context.description.co_simulation;
    let library = |error: String| Finding::error("library", error);
    let missing = look_up(&context.folder, &capabilities.model_identifier).map_err(|e| library(e.to_string()))?;
    for name in &missing.beside {
        let what = format!("it needs {name}, which lies beside it, where most loaders do not look");
        context.find(Finding::warning("library-beside", what));
    }
    for name in &missing.required {
        context.find(Finding::error("missing-symbol", format!("the library has no function {name}")));
    }
    let promised: [(bool, &str, &[&str]); 4] = [
        (
            capabilities.can_get_and_set_state,
            "canGetAndSetFMUstate",
            &["fmi2GetFMUstate", "fmi2SetFMUstate", "fmi2FreeFMUstate"],
        ),
        (
            capabilities.can_serialize_state,
            "canSerializeFMUstate",
            &["fmi2SerializedFMUstateSize", "fmi2SerializeFMUstate", "fmi2DeSerializeFMUstate"],
        ),
        (
            capabilities.provides_directional_derivative,
            "providesDirectionalDerivative",
            &["fmi2GetDirectionalDerivative"],
        ),
        (capabilities.can_interpolate_inputs, "canInterpolateInputs", &["fmi2SetRealInputDerivatives"]),
    ];
    let mut others = missing.demanded.clone();
    for (_, flag, functions) in promised.iter().filter(|(declared, ..)| *declared) {
        let lost: Vec<_> = functions.iter().filter(|name| missing.demanded.contains(name)).copied().collect();
        others.retain(|name| !lost.contains(name));
        if !lost.is_empty() {
            let what = format!("{flag} is true, but the library has no function {}", lost.join(", "));
            context.find(Finding::error("flag-without-symbol", what));
        }
    }
    if !others.is_empty() {
        let what = format!("the library lacks functions that every co-simulation FMU must have: {}", others.join(", "));
        context.find(Finding::warning("incomplete-library", what));
    }
    if missing.required.is_empty() {
        open(context)?;
    }
    Ok(())
}

/// A short run with all messages on.
pub fn life(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    let mut drive = Drive::born(&probe, &plan, &Instantiation { logging: true, ..plan.instantiation() })?;
    let outcome = drive.steps(0..plan.steps(FEW), 0.0);
    let warned = drive.warnings;
    let categories = !context.description.log_categories.is_empty();
    for entry in drive.instance.take_log() {
        // Without categories in the description the category has to be NULL.
        let odd = |oddity: &&&str| categories || **oddity != ODDITIES[1];
        for oddity in entry.oddities.iter().filter(odd) {
            let finding = Finding::warning("logger-call", format!("it calls the logger with {oddity}"));
            context.find(finding.seen(format!("{:?}", entry.text)));
        }
    }
    if warned > 0 {
        let what = "calls answer fmi2Warning in an ordinary run";
        context.find(Finding::warning("warnings", what).seen(format!("{warned} times in {FEW} steps")));
    }
    outcome?;
    let status = drive.instance.terminate();
    drive.ok(status, "fmi2Terminate")?;
    drive.outputs()?;
    drive.instance.free();
    Ok(())
}

/// A wrong GUID is to be refused; the right one was accepted before.
pub fn guid(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    let wrong = "{deadbeef-dead-beef-dead-beefdeadbeef}";
    let tried = if plan.several { 2 } else { 1 };
    for (guid, words) in [(wrong, "a wrong GUID"), ("", "an empty GUID")].into_iter().take(tried) {
        if probe.instantiate(&Instantiation { guid, ..plan.instantiation() }).is_ok() {
            let what =
                "fmi2Instantiate accepts a GUID that is not its own: a description of another build goes unnoticed";
            context.find(Finding::warning("guid-unchecked", what).seen(format!("accepted {words}")));
            return Ok(());
        }
    }
    Ok(())
}

/// Forms of the URI of the resources folder that masters send, and a folder with a blank in its name.
pub fn resources(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    if !plan.several {
        return Ok(()); // each form takes another instance
    }
    let blank = std::env::temp_dir().join("a blank, ü");
    let linked = ttb_fmi::platform::link_folder(&context.folder, &blank).is_ok();
    let path = |folder: &std::path::Path| file_uri(&folder.join("resources"))["file://".len()..].to_string();
    let (plain, encoded) = (path(&context.folder), path(&blank));
    let forms = [
        (format!("file://{plain}"), true),
        (format!("file:{plain}"), true),
        (format!("file://{plain}/"), false),
        (format!("file:///{plain}"), false),
        (format!("file://{encoded}"), linked),
    ];
    let reference = reference(&probe, &plan, plan.steps(FEW))?;
    for (uri, standard) in forms.iter().filter(|(uri, _)| linked || *uri != forms[4].0) {
        let what = "it does not understand every form of the resources' URI";
        let finding =
            if *standard { Finding::error("resource-uri", what) } else { Finding::remark("resource-uri", what) };
        let form = uri.replace(&plain, "/PATH").replace(&encoded, "/PATH%20WITH%20BLANK");
        let wanted = Instantiation { resources: uri, ..plan.instantiation() };
        let ran = Drive::born(&probe, &plan, &wanted).and_then(|mut drive| {
            let run = drive.steps(0..plan.steps(FEW), 0.0)?;
            drive.instance.free();
            match &reference {
                Some(reference) => confirmed(&probe, &plan, reference, &run, 1e-9),
                None => Ok(None),
            }
        });
        match ran {
            Ok(None) => {}
            Ok(Some(difference)) => context.find(finding.at(form).seen(difference)),
            Err(refused) => context.find(finding.at(form).seen(format!("{} {}", refused.what, refused.evidence))),
        }
    }
    Ok(())
}

/// fmi2FreeInstance at moments when masters in trouble call it.
pub fn free(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    if !plan.several {
        let mut drive = Drive::fresh(&probe, &plan)?;
        drive.steps(0..plan.steps(FEW), 0.0)?;
        drive.instance.free();
        return Ok(());
    }
    let newborn = || probe.instantiate(&plan.instantiation()).map_err(|log| Finding::error("no-instance", last(&log)));
    newborn()?.free();
    let mut instance = newborn()?;
    instance.setup_experiment(plan.start, plan.stop);
    instance.enter_initialization();
    instance.free();
    let mut drive = Drive::fresh(&probe, &plan)?;
    drive.steps(0..plan.steps(FEW), 0.0)?;
    drive.instance.free();
    Ok(())
}
