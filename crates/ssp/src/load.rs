//! A structure with all files that it names: parameter sets, mappings, structures within it. What FMUs contain is not
//! looked at.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use crate::bindings::{read_mapping, read_set};
use crate::parameters::{Binding, Mapping, Values};
use crate::problem::Report;
use crate::read::structure;
use crate::types::{Component, Connector, FileKind, STRUCTURE, Source, Structure, System, Type, Unit};
use crate::uri::Base;

/// Structures within structures at most.
const DEPTH: usize = 20;

/// Opens files for [`load`].
pub trait Files {
    /// The content of a file.
    ///
    /// # Errors
    /// Why there is none.
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, String>;

    /// Unpacks an archive, once, and gives the folder.
    ///
    /// # Errors
    /// Why it cannot be unpacked.
    fn unpack(&mut self, path: &Path) -> Result<PathBuf, String>;
}

/// A document and what it names.
#[derive(Debug, Default)]
pub struct Loaded {
    /// The structure; structures within it have become systems, parameter sets and mappings stand inside, and components
    /// know their files.
    pub structure: Structure,
    /// Files that were read beside the document.
    pub read: Vec<PathBuf>,
}

/// Reads a document and all that it names. Problems go to `report`, which is the document's; what could be read is given
/// all the same.
pub fn load(bytes: &[u8], base: &Base, files: &mut dyn Files, report: &mut Report) -> Loaded {
    let mut loaded = Loaded::default();
    let Some(structure) = structure(bytes, report) else { return loaded };
    let mut loader = Loader { files, loaded: &mut loaded, depth: 0 };
    let structure = loader.structure(structure, base, report);
    loaded.structure = structure;
    loaded
}

struct Loader<'a> {
    files: &'a mut dyn Files,
    loaded: &'a mut Loaded,
    depth: usize,
}

impl Loader<'_> {
    fn structure(&mut self, mut structure: Structure, base: &Base, report: &mut Report) -> Structure {
        let Structure { system, units, .. } = &mut structure;
        self.system(system, units, base, report);
        structure
    }

    fn system(&mut self, system: &mut System, units: &mut Vec<Unit>, base: &Base, report: &mut Report) {
        self.bindings(&mut system.bindings, base, None, report);
        system.systems.iter_mut().for_each(|inner| self.system(inner, units, base, report));
        let mut fmus = Vec::new();
        for mut component in std::mem::take(&mut system.components) {
            let file = match base.find(&component.source) {
                // What is wrong with the source itself has been told.
                _ if component.source.path.is_empty() => None,
                Ok(file) => Some(file),
                Err(why) => {
                    report.problem(&component.place, why);
                    None
                }
            };
            self.bindings(&mut component.bindings, base, file.as_deref(), report);
            match (component.content, file) {
                (FileKind::Fmu, file) => fmus.push(Component { file, ..component }),
                (_, Some(file)) => system.systems.extend(self.nested(component, &file, units, report)),
                (_, None) => {}
            }
        }
        system.components = fmus;
    }

    /// A component that is a structure itself becomes a system, whose last bindings are the component's.
    fn nested(
        &mut self,
        component: Component,
        file: &Path,
        units: &mut Vec<Unit>,
        report: &mut Report,
    ) -> Option<System> {
        let failed = |report: &mut Report, why: String| {
            report.problem(&component.place, why);
            None
        };
        if self.depth == DEPTH {
            return failed(report, format!("structures are nested more than {DEPTH} deep"));
        }
        let (document, base) = if component.content == FileKind::Package {
            let folder = match self.files.unpack(file) {
                Ok(folder) => folder,
                Err(why) => return failed(report, why),
            };
            let variant = component.source.variant.as_deref().unwrap_or(STRUCTURE);
            let name = format!("the archive {}", component.source);
            (folder.join(variant), Base { archive: Some(folder.clone()), folder, name })
        } else {
            let folder = file.parent().unwrap_or(Path::new("")).to_path_buf();
            (file.to_path_buf(), Base { archive: None, folder, name: format!("the folder of {}", component.source) })
        };
        let bytes = match self.files.read(&document) {
            Ok(bytes) => bytes,
            Err(why) => return failed(report, why),
        };
        self.loaded.read.push(file.to_path_buf());
        let mut own = Report::new(format!("{}: {}", report.file(), component.source));
        self.depth += 1;
        let inner = structure(&bytes, &mut own).map(|inner| self.structure(inner, &base, &mut own));
        self.depth -= 1;
        report.absorb(own);
        let mut inner = inner?;
        rename(&mut inner, units);
        // A place says in which document it stands, so that no two components share one.
        at(&mut inner.system, &component.place);
        let Component { name, bindings, .. } = component;
        inner.system.bindings.extend(bindings);
        Some(System { name, ..inner.system })
    }

    /// Brings sets and mappings in; `component` is the file that some of them stand in.
    fn bindings(&mut self, bindings: &mut [Binding], base: &Base, component: Option<&Path>, report: &mut Report) {
        for binding in bindings {
            let place = binding.place.clone();
            if let Values::File(source) = &binding.values {
                let set = self.open(source, base, component, &place, report, read_set);
                binding.values = set.map_or_else(Values::default, Values::Inline);
            }
            if let Some(Mapping::File(source)) = &binding.mapping {
                let entries = self.open(source, base, component, &place, report, read_mapping);
                binding.mapping = Some(Mapping::Inline(entries.unwrap_or_default()));
            }
        }
    }

    fn open<T>(
        &mut self,
        source: &Source,
        base: &Base,
        component: Option<&Path>,
        place: &str,
        report: &mut Report,
        read: impl Fn(&[u8], &mut Report) -> Option<T>,
    ) -> Option<T> {
        let mut bytes = || -> Result<Vec<u8>, String> {
            let path = match (source.in_component, component) {
                (false, _) => base.find(source)?,
                (true, None) => return Err("sourceBase is component, but there is no file of a component".into()),
                (true, Some(file)) => {
                    let folder = self.files.unpack(file)?;
                    let name = format!("{}", file.file_name().unwrap_or_default().display());
                    Base { archive: Some(folder.clone()), folder, name }.find(source)?
                }
            };
            let bytes = self.files.read(&path)?;
            self.loaded.read.push(path);
            Ok(bytes)
        };
        match bytes() {
            Ok(bytes) => {
                let mut own = Report::new(format!("{}: {source}", report.file()));
                let read = read(&bytes, &mut own);
                report.absorb(own);
                read
            }
            Err(why) => {
                report.problem(place, why);
                None
            }
        }
    }
}

/// Units of a structure within another join those of the outer one; one that means something else there gets another name.
fn rename(inner: &mut Structure, units: &mut Vec<Unit>) {
    let mut names = HashMap::new();
    for unit in &inner.units {
        let mut name = unit.name.clone();
        while units.iter().any(|known| known.name == name && known.base != unit.base) {
            name.push('\'');
        }
        if units.iter().all(|known| known.name != name) {
            units.push(Unit { name: name.clone(), base: unit.base });
        }
        names.insert(unit.name.clone(), name);
    }
    units_of(&mut inner.system, &names);
}

fn units_of(system: &mut System, names: &HashMap<String, String>) {
    let change = |connector: &mut Connector| {
        if let Some(Type::Real(Some(unit))) = &mut connector.kind_of_value
            && let Some(name) = names.get(unit)
        {
            unit.clone_from(name);
        }
    };
    system.connectors.iter_mut().for_each(change);
    system.components.iter_mut().flat_map(|component| &mut component.connectors).for_each(change);
    system.signals.iter_mut().flat_map(|signal| &mut signal.connectors).for_each(change);
    system.systems.iter_mut().for_each(|inner| units_of(inner, names));
}

/// Puts the place of the component that a system comes from before all places in it.
fn at(system: &mut System, place: &str) {
    let put = |own: &mut String| *own = format!("{place}: {own}");
    for component in &mut system.components {
        put(&mut component.place);
        component.connectors.iter_mut().for_each(|connector| put(&mut connector.place));
        component.bindings.iter_mut().for_each(|binding| put(&mut binding.place));
    }
    system.connectors.iter_mut().for_each(|connector| put(&mut connector.place));
    system.connections.iter_mut().for_each(|connection| put(&mut connection.place));
    system.bindings.iter_mut().for_each(|binding| put(&mut binding.place));
    system.signals.iter_mut().flat_map(|signal| &mut signal.connectors).for_each(|connector| put(&mut connector.place));
    system.systems.iter_mut().for_each(|inner| at(inner, place));
}
