//! Bindings, mappings and systems in systems as SSP has them: which value each variable ends with, which output drives it.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use ttb_ssp::{Base, Files, Flat, Hop, Report, Transformation, Value, flatten, load};

/// Files in memory; an archive is a folder of the same name.
struct Memory(HashMap<PathBuf, String>);

impl Files for Memory {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, String> {
        self.0.get(path).map(|text| text.clone().into_bytes()).ok_or_else(|| format!("no {}", path.display()))
    }
    fn unpack(&mut self, path: &Path) -> Result<PathBuf, String> {
        Ok(path.with_extension("folder"))
    }
}

const SET: &str = "<ssv:ParameterSet version='2.0' name='p'><ssv:Parameters>";

fn set(parameters: &[(&str, f64)]) -> String {
    let one = |(name, x): &(&str, f64)| format!("<ssv:Parameter name='{name}'><ssv:Real value='{x}'/></ssv:Parameter>");
    format!("{SET}{}</ssv:Parameters></ssv:ParameterSet>", parameters.iter().map(one).collect::<String>())
}

fn inline(set: &str, attributes: &str, mapping: &str) -> String {
    format!(
        "<ssd:ParameterBinding {attributes}><ssd:ParameterValues>{set}</ssd:ParameterValues>{mapping}</ssd:ParameterBinding>"
    )
}

fn bindings(all: &[String]) -> String {
    format!("<ssd:ParameterBindings>{}</ssd:ParameterBindings>", all.concat())
}

fn connectors(all: &[(&str, &str)]) -> String {
    let one = |(name, kind): &(&str, &str)| {
        format!("<ssd:Connector name='{name}' kind='{kind}'><ssc:Float64/></ssd:Connector>")
    };
    format!("<ssd:Connectors>{}</ssd:Connectors>", all.iter().map(one).collect::<String>())
}

fn component(name: &str, inside: &str) -> String {
    format!("<ssd:Component name='{name}' source='a%20b.fmu'>{inside}</ssd:Component>")
}

fn connection(start: [&str; 2], end: [&str; 2], inside: &str) -> String {
    let of =
        |which: &str, element: &str| if element.is_empty() { String::new() } else { format!("{which}='{element}'") };
    let ends = [of("startElement", start[0]), of("endElement", end[0])];
    format!(
        "<ssd:Connection {} startConnector='{}' {} endConnector='{}'>{inside}</ssd:Connection>",
        ends[0], start[1], ends[1], end[1]
    )
}

fn system(name: &str, inside: &str, elements: &str, connections: &str) -> String {
    format!(
        "<ssd:System name='{name}'>{inside}<ssd:Elements>{elements}</ssd:Elements><ssd:Connections>{connections}</ssd:Connections></ssd:System>"
    )
}

fn document(system: &str) -> String {
    format!("<ssd:SystemStructureDescription version='2.0' name='d'>{system}</ssd:SystemStructureDescription>")
}

/// Flattens a document whose folder has the FMU and these files.
fn flat(text: &str, files: &[(&str, String)]) -> Result<Flat, String> {
    let folder = tempfile::tempdir().unwrap();
    let mut memory = Memory(HashMap::new());
    for (name, text) in files.iter().chain([&("a b.fmu", String::new())]) {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        memory.0.insert(path, text.clone());
    }
    let base = Base { archive: Some(folder.path().into()), folder: folder.path().into(), name: "the archive".into() };
    let mut report = Report::new("d.ssd");
    let loaded = load(text.as_bytes(), &base, &mut memory, &mut report);
    let flat = flatten(&loaded.structure, &mut report);
    if report.is_empty() { Ok(flat) } else { Err(report.to_string()) }
}

/// What a variable of a component ends with, and what happens to it on its way.
fn last<'a>(flat: &'a Flat, component: &str, variable: &str) -> Option<(&'a Value, &'a [Hop])> {
    let at = flat.components.iter().position(|known| known.name == component).unwrap();
    let found = flat.values[at].iter().rfind(|bound| bound.variable == variable)?;
    Some((&found.value, &found.hops))
}

fn number(flat: &Flat, component: &str, variable: &str) -> f64 {
    match last(flat, component, variable) {
        Some((Value::Real(x, None), _)) => *x,
        other => panic!("{component}.{variable}: {other:?}"),
    }
}

#[test]
fn the_outermost_binding_holds_and_on_one_level_the_last() {
    let inner = component("C", &bindings(&[inline(&set(&[("a", 1.0), ("b", 1.0), ("c", 1.0), ("d", 1.0)]), "", "")]));
    let two = [inline(&set(&[("C.b", 2.0), ("C.c", 2.0)]), "", ""), inline(&set(&[("c", 3.0)]), "prefix='C.'", "")];
    let middle = system("S", &bindings(&two), &inner, "");
    let outer = system("R", &bindings(&[inline(&set(&[("S.C.d", 4.0), ("nowhere", 9.0)]), "", "")]), &middle, "");
    let flat = flat(&document(&outer), &[]).unwrap();
    assert_eq!(flat.components[0].name, "S.C");
    assert_eq!(["a", "b", "c", "d"].map(|name| number(&flat, "S.C", name)), [1.0, 2.0, 3.0, 4.0]);
    assert!(flat.offers.iter().any(|offer| offer.name == "nowhere" && !offer.connector));
}

#[test]
fn a_mapping_renames_transforms_and_leaves_out_the_rest() {
    let ssm = "<ssm:ParameterMapping version='1.0'><ssm:MappingEntry source='k' target='C.gain'>\
               <ssc:LinearTransformation factor='4' offset='5'/></ssm:MappingEntry>\
               <ssm:MappingEntry source='k' target='C.other' suppressUnitConversion='true'/>\
               <ssm:MappingEntry source='absent' target='C.x'/><ssm:MappingEntry source='' target='C.z'/>\
               </ssm:ParameterMapping>";
    let files = [("p q.ssv", set(&[("k", 2.0), ("C.y", 7.0)])), ("maps/m.ssm", ssm.to_string())];
    let binding =
        "<ssd:ParameterBinding source='p%20q.ssv'><ssd:ParameterMapping source='maps/m.ssm'/></ssd:ParameterBinding>";
    let flat = flat(&document(&system("R", &bindings(&[binding.into()]), &component("C", ""), "")), &files).unwrap();
    let (value, hops) = last(&flat, "C", "gain").unwrap();
    assert_eq!(value, &Value::Real(2.0, None));
    assert_eq!(hops[0].transformation, Some(Transformation::Linear { factor: 4.0, offset: 5.0 }));
    assert!(last(&flat, "C", "other").unwrap().1[0].suppress_unit_conversion);
    assert_eq!(last(&flat, "C", "y"), None);
    assert!(flat.warnings.len() == 1 && flat.warnings[0].contains("no parameter absent"), "{:?}", flat.warnings);
}

#[test]
fn a_value_of_a_system_s_connector_goes_where_its_connections_lead() {
    let factor = "<ssc:LinearTransformation factor='10'/>";
    let inner = system(
        "S",
        &connectors(&[("p", "parameter")]),
        &component("C", &connectors(&[("k", "parameter")])),
        &connection(["", "p"], ["C", "k"], factor),
    );
    let own = bindings(&[inline(&set(&[("top", 3.0)]), "", "")]);
    let inside = format!("{}{own}", connectors(&[("top", "parameter")]));
    let flat = flat(&document(&system("R", &inside, &inner, &connection(["", "top"], ["S", "p"], ""))), &[]).unwrap();
    let (value, hops) = last(&flat, "S.C", "k").unwrap();
    assert_eq!((value, hops.len()), (&Value::Real(3.0, None), 3));
    assert_eq!(hops[2].transformation, Some(Transformation::Linear { factor: 10.0, offset: 0.0 }));
    assert_eq!(flat.undriven, vec![(0, "k".to_string(), "top".to_string())]);
}

#[test]
fn wires_lead_through_systems_and_dictionaries_whichever_end_is_written_first() {
    let give = system(
        "G",
        &connectors(&[("out", "output")]),
        &component("A", &connectors(&[("y", "output")])),
        &connection(["", "out"], ["A", "y"], ""),
    );
    let take = component("B", &connectors(&[("u", "input"), ("v", "input")]));
    let bus = "<ssd:SignalDictionaryReference name='bus' dictionary='D'>\
               <ssd:Connectors><ssd:Connector name='s' kind='inout'/></ssd:Connectors></ssd:SignalDictionaryReference>";
    let wires = [
        connection(["B", "u"], ["G", "out"], "<ssc:LinearTransformation offset='1'/>"),
        connection(["G", "out"], ["bus", "s"], ""),
        connection(["B", "v"], ["bus", "s"], ""),
    ];
    let inside = "<ssd:SignalDictionaries><ssd:SignalDictionary name='D'/></ssd:SignalDictionaries>";
    let text = document(&system("R", inside, &[give, take, bus.to_string()].concat(), &wires.concat()));
    let flat = flat(&text, &[]).unwrap();
    let a = flat.components.iter().position(|component| component.name == "G.A").unwrap();
    let ends: Vec<_> = flat.wires.iter().map(|wire| (wire.from.clone(), wire.to.1.as_str(), wire.hops.len())).collect();
    assert_eq!(ends, [((a, "y".to_string()), "u", 2), ((a, "y".to_string()), "v", 3)]);
}

#[test]
fn a_structure_within_a_structure_is_a_system_whose_last_bindings_are_the_component_s() {
    let inner = document(&system(
        "x",
        &bindings(&[inline(&set(&[("C.a", 1.0), ("C.b", 1.0)]), "", "")]),
        &component("C", ""),
        "",
    ));
    let nested = format!(
        "<ssd:Component name='N' type='application/x-ssp-definition' source='inner.ssd'>{}</ssd:Component>",
        bindings(&[inline(&set(&[("C.b", 2.0)]), "", "")])
    );
    let flat = flat(&document(&system("R", "", &nested, "")), &[("inner.ssd", inner)]).unwrap();
    assert_eq!(["a", "b"].map(|name| number(&flat, "N.C", name)), [1.0, 2.0]);
    assert!(flat.components[0].file.as_ref().is_some_and(|file| file.ends_with("a b.fmu")));
}

#[test]
fn all_problems_of_all_files_come_at_once() {
    let both = "<ssd:ParameterBinding source='p.ssv'/><ssd:ParameterBinding source='absent.ssv'/>";
    let fmu = "<ssd:Component name='D' source='A%20B.fmu'/><ssd:Component name='E' source='../b.fmu'/>";
    let elements = component("C", &connectors(&[("u", "input"), ("y", "output")])) + fmu;
    let wires = connection(["C", "y"], ["C", "u"], "") + &connection(["C", "y"], ["F", "u"], "");
    let bad = "<ssv:ParameterSet version='1.0'><ssv:Parameters><ssv:Parameter name='a'><ssv:Integer value='1.5'/>\
               </ssv:Parameter></ssv:Parameters></ssv:ParameterSet>";
    let inside = bindings(&[both.to_string()]);
    let said = flat(&document(&system("R", &inside, &elements, &wires)), &[("p.ssv", bad.into())]).unwrap_err();
    for what in [
        "d.ssd: p.ssv: /ParameterSet/Parameters/Parameter[@name='a']/Integer: the attribute value is no whole number",
        "the archive has no file absent.ssv",
        "the archive has no file A B.fmu (there is a b.fmu: capitals count)",
        "Component[@name='E']: is \"../b.fmu\": it leads out of the archive",
        "connects a component with itself",
        "there is no component F",
    ] {
        assert!(said.contains(what), "{what}: {said}");
    }
}

#[test]
fn tables_of_values_are_read_and_must_be_unambiguous() {
    let table = |second: i32| {
        format!(
            "<ssd:ParameterBinding><ssd:ParameterValues>{SET}<ssv:Parameter name='k'><ssv:Enumeration value='red'/></ssv:Parameter>\
             </ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues><ssd:ParameterMapping><ssm:ParameterMapping version='1.0'>\
             <ssm:MappingEntry source='k' target='colour'><ssc:IntegerMappingTransformation><ssc:MapEntry source='1' target='5'/>\
             <ssc:MapEntry source='{second}' target='6'/></ssc:IntegerMappingTransformation></ssm:MappingEntry>\
             </ssm:ParameterMapping></ssd:ParameterMapping></ssd:ParameterBinding>"
        )
    };
    let text = |second| document(&system("R", "", &component("C", &bindings(&[table(second)])), ""));
    let good = flat(&text(2), &[]).unwrap();
    let (value, hops) = last(&good, "C", "colour").unwrap();
    assert_eq!(value, &Value::Item("red".into(), None));
    assert_eq!(hops[0].transformation, Some(Transformation::Integer(vec![(1, 5), (2, 6)])));
    assert!(flat(&text(1), &[]).unwrap_err().contains("MapEntry[2]: there is another entry for this source"));
}
