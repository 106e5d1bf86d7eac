//! Reading modelDescription.xml tolerantly, and refusing what cannot be used.
#![cfg(feature = "import")]

use ttb_fmi::description::{DescriptionError, VariableType};
use ttb_fmi2::import::read_description;

fn document(inside: &str) -> String {
    format!("<fmiModelDescription fmiVersion=\"2.0\" modelName=\"m\" guid=\"g\">{inside}</fmiModelDescription>")
}
const SLAVE: &str = "<CoSimulation modelIdentifier=\"m\" canGetAndSetFMUstate=\"1\"/>";

#[test]
fn unknown_elements_attributes_namespaces_and_annotations_are_passed_over() {
    let xml = "\u{feff}<?xml version='1.0' encoding='UTF-8'?>
        <!DOCTYPE fmiModelDescription [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;&a;'>]>
        <!-- a comment --> <?tool data?>
        <fmi:fmiModelDescription xmlns:fmi='http://x' xmlns:xsi='http://y' xsi:schemaLocation='z' fmiVersion='2.0.4'
            modelName='&lt;B&amp;r&#252;cke&gt; &b;' guid='{1}' new='x' new='twice'>
          <fmi:CoSimulation modelIdentifier='B' canInterpolateInputs=' true ' canHandleVariableCommunicationStepSize='false' x:modelIdentifier='no'>
            <SourceFiles><File name='a.c'/></SourceFiles></fmi:CoSimulation>
          <UnitDefinitions><Unit name='mm'><BaseUnit m='1' factor='1e-3'/><DisplayUnit name='m'/></Unit></UnitDefinitions>
          <TypeDefinitions><SimpleType name='Length'><Real unit='mm'/></SimpleType></TypeDefinitions>
          <VendorAnnotations><Tool name='t'><ScalarVariable name='not me' valueReference='9'><Real/></ScalarVariable></Tool></VendorAnnotations>
          <DefaultExperiment stopTime='2.5' tolerance='soft'/>
          <ModelVariables>
            <ScalarVariable name='a' valueReference='7' causality='input' q='1'>
              <Annotations><Tool name='t'><Integer start='5'/></Tool></Annotations><Real declaredType='Length' start='1'/></ScalarVariable>
            <ScalarVariable name='b' valueReference=' 7 '><Enumeration declaredType='E' start='2'/></ScalarVariable>
            <ScalarVariable name='c' valueReference='4294967295'><String start=''/></ScalarVariable>
          </ModelVariables><ModelStructure><Outputs/></ModelStructure>
        </fmi:fmiModelDescription>";
    let d = read_description(xml.as_bytes()).unwrap();
    assert_eq!((d.fmi_version.as_str(), d.guid.as_str()), ("2.0.4", "{1}"));
    assert!(d.model_name.contains("&b;"), "an entity of the document's own is not expanded: {}", d.model_name);
    assert!(d.co_simulation.can_interpolate_inputs && !d.co_simulation.can_handle_variable_communication_step_size);
    assert_eq!(d.co_simulation.model_identifier, "B");
    assert_eq!((d.start_time, d.stop_time, d.step_size), (None, Some(2.5), None));
    assert_eq!((d.units["mm"].factor, d.units["mm"].powers[1]), (1e-3, 1));
    let found: Vec<_> =
        d.variables.iter().map(|v| (v.name.as_str(), v.value_reference, v.kind, v.start.as_deref())).collect();
    let expected = [
        ("a", 7, VariableType::Real, Some("1")),
        ("b", 7, VariableType::Enumeration, Some("2")),
        ("c", u32::MAX, VariableType::String, Some("")),
    ];
    assert_eq!(found, expected);
    assert_eq!(d.variable("a").unwrap().unit.as_deref(), Some("mm"));
    assert_eq!((d.variable("b").unwrap().causality.as_str(), d.variable("not me")), ("local", None));
}

#[test]
fn latin1_is_read() {
    let xml = document(&format!(
        "{SLAVE}<ModelVariables><ScalarVariable name=\"Br\u{fc}cke\" valueReference=\"0\"><Real/></ScalarVariable></ModelVariables>"
    ));
    let xml = format!("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>{xml}");
    let bytes: Vec<u8> = xml.chars().map(|c| c as u8).collect();
    assert!(read_description(&bytes).unwrap().variable("Br\u{fc}cke").is_some());
}

#[test]
fn what_cannot_be_used_is_refused_with_its_reason() {
    let reason = |xml: &str| read_description(xml.as_bytes()).unwrap_err().to_string();
    assert!(reason("").contains("ends before"));
    assert!(reason("plain text").contains("ends before"));
    assert!(reason("<fmiModelDescription fmiVersion='2.0'></b>").contains("not well-formed"));
    assert!(reason(&document(SLAVE)[..60]).contains("not well-formed"));
    assert!(reason("<fmiModelDescription fmiVersion='2.0'>").contains("ends before"));
    assert_eq!(reason("<SystemStructure/>"), "has the root element SystemStructure, not fmiModelDescription");
    assert!(reason("<fmiModelDescription fmiVersion='3.0'/>").contains("FMI \"3.0\""));
    assert!(reason("<fmiModelDescription fmiVersion='1.0'/>").contains("FMI \"1.0\""));
    assert!(reason(&document("<ModelExchange modelIdentifier='m'/>")).contains("model exchange only"));
    assert!(reason(&document("<CoSimulation/>")).contains("CoSimulation has no usable attribute modelIdentifier"));
    assert!(reason(&document("<CoSimulation modelIdentifier='../evil'/>")).contains("modelIdentifier"));
    let variable =
        |attributes: &str| document(&format!("{SLAVE}<ModelVariables><ScalarVariable {attributes}/></ModelVariables>"));
    assert!(reason(&variable("valueReference='1'")).contains("attribute name"));
    assert_eq!(
        reason(&variable("name='a' valueReference='-1'")),
        "the ScalarVariable a has no usable attribute valueReference"
    );
}

#[test]
fn bombs_do_not_go_off() {
    let deep = document(&format!("{SLAVE}{}{}", "<a>".repeat(1000), "</a>".repeat(1000)));
    assert!(matches!(read_description(deep.as_bytes()), Err(DescriptionError::TooDeep)));
    // Ten levels of ten: 10^10 characters, if anything expanded them.
    let laughs: String =
        (1..10).map(|i| format!("<!ENTITY l{i} \"{}\">", format!("&l{};", i - 1).repeat(10))).collect();
    let xml = format!("<!DOCTYPE x [<!ENTITY l0 'ha'>{laughs}]>{}", document(SLAVE).replace("\"m\"", "\"&l9;\""));
    assert_eq!(read_description(xml.as_bytes()).unwrap().model_name, "&l9;");
}

#[test]
fn a_name_or_a_reference_with_two_meanings_is_ambiguous() {
    let variable = |name: &str, reference: u32, causality: &str| {
        format!(
            "<ScalarVariable name='{name}' valueReference='{reference}' causality='{causality}'><Real/></ScalarVariable>"
        )
    };
    let of = |variables: &[String]| {
        let xml = format!(
            "<fmiModelDescription fmiVersion='2.0' guid='g'><CoSimulation modelIdentifier='M'/><ModelVariables>{}</ModelVariables>\
             </fmiModelDescription>",
            variables.concat()
        );
        read_description(xml.as_bytes()).unwrap().ambiguity()
    };
    let (a, b) = (variable("a", 1, "input"), variable("b", 1, "input"));
    assert_eq!(of(&[a.clone(), b]).unwrap(), "the inputs a and b share the value reference 1");
    assert_eq!(of(&[a.clone(), variable("a", 2, "output")]).unwrap(), "two variables are called a");
    // Aliases of outputs and locals are common and harmless.
    assert_eq!(of(&[a, variable("y", 2, "output"), variable("z", 2, "output"), variable("a", 1, "local")]), None);
}
