//! The test model packed as an FMU and loaded like anyone's: what the master sees of ours.
#![cfg(feature = "import")]
#![allow(clippy::undocumented_unsafe_blocks)] // a test calls functions of a library it has just made

mod foreign;
#[path = "models/oscillator.rs"]
#[allow(dead_code)]
mod oscillator;

use foreign::*;
use oscillator::{Oscillator, vr};
use std::path::Path;
use ttb_contract::{InProcess, Instance, Model, Subsystem};
use ttb_fmi::{Fmu, FmuInstance, FmuSubsystem};
use ttb_model_description::{About, Contents, Libraries, pack};

/// Packs the example library with a mass of 2 kg.
fn packed(folder: &Path) -> (Fmu, Oscillator) {
    let resources = folder.join("resources");
    std::fs::create_dir_all(&resources).unwrap();
    std::fs::write(resources.join("mass.txt"), "2").unwrap();
    let model = Oscillator::load(&resources).unwrap();
    let about = About::of(&model, "Oscillator", "Oscillator", "One mass on a spring.");
    let library = example_library();
    let licenses = [("LICENSE.txt", "MIT OR Apache-2.0")];
    let contents = Contents {
        interface: model.interface(),
        about: &about,
        libraries: Libraries::File(&library),
        resources: Some(&resources),
        licenses: &licenses,
    };
    let path = folder.join("Oscillator.fmu");
    pack(&contents, std::fs::File::create(&path).unwrap()).unwrap();
    (ttb_fmi2::import::open(&path).unwrap(), model)
}

fn coupled(instance: FmuInstance) -> FmuSubsystem {
    FmuSubsystem::new(instance, &["support[1].force"], &["support[1].displacement", "support[1].velocity"]).unwrap()
}

/// A run with roll-backs, as bits.
fn run(s: &mut impl Subsystem) -> Vec<u64> {
    let mut trace = Vec::new();
    let mut out = [0.0; 2];
    s.exit_initialization().unwrap();
    for step in 0..50 {
        let t = 0.01 * f64::from(step);
        s.save().unwrap();
        for sweep in 0..3 {
            if sweep > 0 {
                s.restore().unwrap();
            }
            let force = 10.0 * (t + f64::from(sweep)).sin();
            s.set_inputs(&[force], (step % 2 == 0).then_some(&[-3.0 * force])).unwrap();
            s.step(t, 0.01, true).unwrap();
            s.get_outputs(&mut out).unwrap();
            trace.extend(out.map(f64::to_bits));
        }
    }
    trace
}

#[test]
fn a_run_through_the_fmu_is_the_run_in_process_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let (fmu, model) = packed(folder.path());
    let mut instance = fmu.instantiate("ours", false).unwrap();
    instance.set_number("stiffness", 75.0).unwrap();
    instance.setup_experiment(0.0, Some(0.5)).unwrap();
    instance.enter_initialization().unwrap();
    let through_fmu = run(&mut coupled(instance));

    let mut instance = Instance::new(model);
    instance.set(&[vr::STIFFNESS], &[75.0]).unwrap();
    instance.enter_initialization(0.0).unwrap();
    let in_process = run(&mut InProcess::new("ours", instance, vec![vr::FORCE], vec![vr::DISPLACEMENT, vr::VELOCITY]));
    assert_eq!(through_fmu, in_process);
}

#[test]
fn the_description_read_back_is_the_interface_that_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let (fmu, model) = packed(folder.path());
    let d = fmu.description();
    assert_eq!(d.guid, ttb_model_description::guid("Oscillator", model.interface()));
    assert_eq!((d.start_time, d.stop_time, d.step_size), (Some(0.0), Some(1.0), Some(0.01)));
    let c = &d.co_simulation;
    assert!(
        c.can_get_and_set_state
            && c.can_serialize_state
            && c.can_interpolate_inputs
            && c.provides_directional_derivative
    );
    assert!(c.can_handle_variable_communication_step_size && c.can_not_use_memory_management_functions);
    assert!(!c.needs_execution_tool && !c.can_be_instantiated_only_once_per_process && !c.can_run_asynchronously);
    let names: Vec<_> = model.interface().variables().iter().map(|v| v.name.as_str()).collect();
    assert_eq!(d.variables.iter().map(|v| v.name.as_str()).collect::<Vec<_>>(), names);
    assert!(d.variables.iter().enumerate().all(|(i, v)| v.value_reference as usize == i));
    assert_eq!(d.variable("support[1].force").unwrap().unit.as_deref(), Some("N"));
    assert_eq!(d.variable("seed").unwrap().start.as_deref(), Some("3"));
    assert_eq!(d.units["N"].powers, [1, 1, -2, 0, 0, 0, 0, 0]);
    assert_eq!(d.with_causality("output").count(), 2);
}

#[test]
fn numbers_of_every_type_are_set_and_read_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let mut s = packed(folder.path()).0.instantiate("ours", false).unwrap();
    for (name, value) in [("stiffness", 1.5), ("seed", 7.0), ("misbehaviour", 3.0), ("damped", 0.0)] {
        s.set_number(name, value).unwrap();
        assert_eq!(s.get_number(name).unwrap(), value, "{name}");
    }
    assert!(s.set_number("seed", 1.5).unwrap_err().to_string().contains("seed is an Integer and cannot be set to 1.5"));
    let error = s.get_string(vr::SEED).unwrap_err().to_string();
    assert!(
        error.contains("fmi2GetString answered fmi2Error; it logged: fmi2GetString: this FMU has no String variables"),
        "{error}"
    );
}

#[test]
fn states_travel_between_instances_as_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let fmu = packed(folder.path()).0;
    let start = |name: &str| {
        let mut s = fmu.instantiate(name, false).unwrap();
        s.enter_initialization().unwrap();
        s.exit_initialization().unwrap();
        s
    };
    let (mut a, mut b) = (start("a"), start("b"));
    let (slot_a, slot_b) = (a.new_slot(), b.new_slot());
    a.set_real(&[vr::FORCE], &[10.0]).unwrap();
    a.do_step(0.0, 0.01, false).unwrap();
    a.save(&slot_a).unwrap();
    let bytes = a.serialize(&slot_a).unwrap();
    b.deserialize(&bytes, &slot_b).unwrap();
    b.restore(&slot_b).unwrap();
    for s in [&mut a, &mut b] {
        s.do_step(0.01, 0.01, false).unwrap();
    }
    let (mut x, mut y) = ([0.0; 2], [0.0; 2]);
    a.get_real(&[1, 2], &mut x).unwrap();
    b.get_real(&[1, 2], &mut y).unwrap();
    assert!(x == y && x[0] != 0.0);
    let mut derivative = [0.0; 2];
    a.directional_derivative(&[1, 2], &[0], &[1.0], &mut derivative).unwrap();
    assert!(derivative.iter().all(|d| *d > 0.0));
}

#[test]
fn another_binary_than_the_description_belongs_to_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (fmu, _) = packed(folder.path());
    let xml = std::fs::read_to_string(fmu.folder().join("modelDescription.xml")).unwrap();
    let changed = xml.replace(&fmu.description().guid, "{another}");
    let library = std::fs::read(example_library()).unwrap();
    let made = foreign::fmu(&[
        ("modelDescription.xml", changed.as_bytes()),
        ("binaries/linux64/Oscillator.so", &library),
        ("resources/mass.txt", b"2"),
    ]);
    let error = ttb_fmi2::import::open(&made.path).unwrap().instantiate("x", false).err().unwrap().to_string();
    assert!(error.contains("{another}") && error.contains(&fmu.description().guid), "{error}");
}

#[test]
fn without_a_location_the_resources_beside_the_library_are_used() {
    let folder = tempfile::tempdir().unwrap();
    let (fmu, _) = packed(folder.path());
    let library = unsafe { libloading::Library::new(fmu.folder().join("binaries/linux64/Oscillator.so")) }.unwrap();
    let guid = std::ffi::CString::new(fmu.description().guid.as_str()).unwrap();
    type Instantiate = unsafe extern "C" fn(*const i8, i32, *const i8, *const i8, *const u8, i32, i32) -> *mut u8;
    let free = unsafe { library.get::<unsafe extern "C" fn(*mut u8)>("fmi2FreeInstance") }.unwrap();
    let instantiate = unsafe { library.get::<Instantiate>("fmi2Instantiate") }.unwrap();
    let c = unsafe { instantiate(c"x".as_ptr(), 1, guid.as_ptr(), std::ptr::null(), std::ptr::null(), 0, 0) };
    assert!(!c.is_null());
    unsafe { free(c) };
}

#[test]
fn all_44_functions_are_exported_and_only_harmless_libraries_needed() {
    let names = "GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance SetupExperiment EnterInitializationMode \
        ExitInitializationMode Terminate Reset GetReal GetInteger GetBoolean GetString SetReal SetInteger SetBoolean SetString \
        GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate GetDirectionalDerivative \
        EnterEventMode NewDiscreteStates EnterContinuousTimeMode CompletedIntegratorStep SetTime SetContinuousStates GetDerivatives \
        GetEventIndicators GetContinuousStates GetNominalsOfContinuousStates SetRealInputDerivatives GetRealOutputDerivatives DoStep \
        CancelStep GetStatus GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus";
    assert_eq!(names.split_whitespace().count(), 44);
    let library = unsafe { libloading::Library::new(example_library()) }.unwrap();
    for name in names.split_whitespace() {
        assert!(unsafe { library.get::<unsafe extern "C" fn()>(format!("fmi2{name}")) }.is_ok(), "fmi2{name}");
    }
    let Ok(readelf) = std::process::Command::new("readelf").arg("-d").arg(example_library()).output() else { return };
    let dynamic = String::from_utf8_lossy(&readelf.stdout).into_owned();
    for needed in dynamic.lines().filter(|line| line.contains("(NEEDED)")) {
        assert!(
            ["libc.so", "libm.so", "libgcc_s.so", "ld-linux"].iter().any(|known| needed.contains(known)),
            "{needed}"
        );
    }
}
