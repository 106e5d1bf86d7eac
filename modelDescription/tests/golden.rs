//! The XML of a small model with every kind of variable, compared with golden/small.xml letter by letter (but for GUID,
//! version and licence, which follow the workspace).
//!
//! After an intended change: `UPDATE_GOLDEN=1 cargo test -p ttb-model-description`, then read the difference.

use std::io::Cursor;
use std::path::Path;
use ttb_contract::{Interface, Kind, Variable};
use ttb_model_description::{About, Contents, Libraries, PackError, XmlError, pack, xml};

const CHOICES: Kind = Kind::Enumeration(&[("Held", "inputs are held"), ("Line", "inputs run along a line")]);

fn interface() -> Interface {
    let input = |i: usize| Variable::input(format!("support[{i}].force"), "N", "force on the bridge, downwards");
    let mut through = Variable::output("support[1].displacement", "m", "at the \"abutment\" <first>\nin track order");
    through.feed_through = true;
    Interface::new(
        vec![input(1), input(2)],
        vec![through, Variable::output("point[mid].moment", "N.m", "")],
        vec![
            Variable::parameter("damping.ratio", "1", 0.01, "of all modes"),
            Variable::parameter_of("inputs", CHOICES, 2.0, "meaning of inputs"),
            Variable::parameter_of("track.weight", Kind::Boolean, 1.0, "whether the track's weight counts"),
            Variable::parameter_of("seed", Kind::Integer { min: 0, max: 99 }, 7.0, "of the random phases"),
        ],
    )
}

fn about() -> About<'static> {
    let description = "A bridge & its supports.";
    About {
        model_identifier: "Small",
        model_name: "Small",
        description,
        step: 1e-3,
        stop: 12.5,
        directional_derivatives: true,
        date: None,
    }
}

#[test]
fn the_description_of_the_small_model_is_the_golden_one() {
    let text = xml(&interface(), &about()).unwrap();
    let text = text.replace(&ttb_model_description::guid("Small", &interface()), "{GUID}");
    let text = text.replace(concat!("\"", env!("CARGO_PKG_VERSION"), "\""), "\"VERSION\"");
    let text = text.replace(concat!("ttb ", env!("CARGO_PKG_VERSION")), "ttb VERSION");
    let text = text.replace(concat!("license=\"", env!("CARGO_PKG_LICENSE"), "\""), "license=\"LICENSE\"");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/small.xml");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    assert_eq!(text, std::fs::read_to_string(path).unwrap());
}

#[test]
fn what_fmi_cannot_express_is_refused_by_name() {
    let with = |name: &str, unit| {
        xml(&Interface::new(vec![], vec![], vec![Variable::parameter(name, unit, 1.0, "")]), &about())
    };
    assert!(matches!(with("a", "furlong"), Err(XmlError::UnknownUnit { variable, .. }) if variable == "a"));
    assert!(matches!(with("force[1,2]", "N"), Err(XmlError::BadName(name)) if name == "force[1,2]"));
    let twice = || Variable::input("a", "N", "");
    assert!(matches!(
        xml(&Interface::new(vec![twice(), twice()], vec![], vec![]), &about()),
        Err(XmlError::Duplicate(_))
    ));
    let nan = Variable::parameter("a", "N", f64::NAN, "");
    assert!(matches!(xml(&Interface::new(vec![], vec![], vec![nan]), &about()), Err(XmlError::NotFinite { .. })));
}

/// The bytes of an FMU.
fn packed(contents: &Contents) -> Result<Vec<u8>, PackError> {
    let mut fmu = Cursor::new(Vec::new());
    pack(contents, &mut fmu)?;
    Ok(fmu.into_inner())
}

#[test]
fn the_same_contents_make_the_same_archive_in_fmi_order() {
    let folder = tempfile::tempdir().unwrap();
    let binary = folder.path().join("libanything.so");
    let resources = folder.path().join("in");
    std::fs::create_dir_all(resources.join("deep")).unwrap();
    std::fs::write(&binary, [0x7f, b'E', b'L', b'F']).unwrap();
    std::fs::write(resources.join("model.json"), "{}").unwrap();
    std::fs::write(resources.join("deep/matrix.bin"), [1, 2, 3]).unwrap();
    let (interface, about) = (interface(), about());
    let licenses = [("LICENSE.txt", "MIT OR Apache-2.0")];
    let contents = Contents {
        interface: &interface,
        about: &about,
        libraries: Libraries::File(&binary),
        resources: Some(&resources),
        licenses: &licenses,
    };
    let fmu = packed(&contents).unwrap();
    assert_eq!(fmu, packed(&contents).unwrap());

    let archive = zip::ZipArchive::new(Cursor::new(fmu)).unwrap();
    let names: Vec<String> = archive.file_names().map(|name| name.unwrap().into_owned()).collect();
    let binary = format!("binaries/{}/Small.so", ttb_model_description::package::PLATFORM);
    let expected = [
        "modelDescription.xml",
        &binary,
        "documentation/index.html",
        "documentation/licenses/LICENSE.txt",
        "resources/deep/matrix.bin",
        "resources/model.json",
    ];
    assert_eq!(names, expected);
}

#[test]
fn a_date_that_is_asked_for_stands_in_the_description_and_on_every_entry_and_no_other_does() {
    let folder = tempfile::tempdir().unwrap();
    let binary = folder.path().join("libanything.so");
    std::fs::write(&binary, "ELF").unwrap();
    let interface = interface();
    assert!(!xml(&interface, &about()).unwrap().contains("generationDateAndTime"));
    let date = ttb_model_description::Date::from_epoch(1_709_210_096);
    let dated = About { date, ..about() };
    assert!(xml(&interface, &dated).unwrap().contains(" generationDateAndTime=\"2024-02-29T12:34:56Z\""));
    let entries = |about: &About| {
        let contents = Contents {
            interface: &interface,
            about,
            libraries: Libraries::File(&binary),
            resources: None,
            licenses: &[],
        };
        let mut archive = zip::ZipArchive::new(Cursor::new(packed(&contents).unwrap())).unwrap();
        (0..archive.len()).map(|i| archive.by_index(i).unwrap().last_modified().unwrap()).collect::<Vec<_>>()
    };
    let expected = zip::DateTime::from_date_and_time(2024, 2, 29, 12, 34, 56).unwrap();
    assert!(entries(&dated).iter().all(|date| *date == expected));
    assert!(entries(&about()).iter().all(|date| *date == zip::DateTime::default()));
}

#[test]
fn a_missing_binary_is_named() {
    let (interface, about) = (interface(), about());
    let binary = Path::new("/nowhere/libnothing.so");
    let contents = Contents {
        interface: &interface,
        about: &about,
        libraries: Libraries::File(binary),
        resources: None,
        licenses: &[],
    };
    let error = packed(&contents).unwrap_err().to_string();
    assert!(error.starts_with("/nowhere/libnothing.so cannot be read"), "{error}");
}

#[test]
fn libraries_for_several_platforms_are_copied_as_they_are_compressed_and_dated() {
    use std::io::Write;
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let names = ["binaries/linux64/Small.so", "binaries/linux64/Other.so", "binaries/win64/Small.dll"];
    for name in names {
        let options = zip::write::SimpleFileOptions::default().compression_level(Some(9));
        zip.start_file(name, options).unwrap();
        zip.write_all(&name.as_bytes().repeat(99)).unwrap();
    }
    let archive = zip.finish().unwrap().into_inner();
    let date = ttb_model_description::Date::from_epoch(1_709_210_096);
    let (interface, about) = (interface(), About { date, ..about() });
    let libraries = Libraries::Archive(&archive);
    let contents = Contents { interface: &interface, about: &about, libraries, resources: None, licenses: &[] };
    let fmu = packed(&contents).unwrap();
    let entry = |file: &[u8], name: &str| {
        let mut archive = zip::ZipArchive::new(std::io::Cursor::new(file)).unwrap();
        let mut bytes = Vec::new();
        std::io::Read::read_to_end(&mut archive.by_name(name).ok()?, &mut bytes).unwrap();
        let entry = archive.by_index_raw(archive.index_for_name(name)?).unwrap();
        Some((bytes, entry.compressed_size(), entry.last_modified()))
    };
    let dated = Some(zip::DateTime::from_date_and_time(2024, 2, 29, 12, 34, 56).unwrap());
    for name in [names[0], names[2]] {
        let (bytes, size, _) = entry(&archive, name).unwrap();
        assert_eq!(entry(&fmu, name), Some((bytes, size, dated)));
    }
    assert_eq!(entry(&fmu, names[1]), None);
    let about = About { model_identifier: "Nobody", ..about };
    let contents = Contents { interface: &interface, about: &about, libraries, resources: None, licenses: &[] };
    assert!(packed(&contents).unwrap_err().to_string().contains("Nobody"));
}
