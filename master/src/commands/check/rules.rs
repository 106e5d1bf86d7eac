//! The rules, each with the clause of FMI 2.0 that it rests on.
//!
//! Sections are those of FMI 2.0.5, compared with its text. A rule without a clause asks for what no master can do without,
//! or what harms the process.

/// A rule.
pub struct Rule {
    /// Always the same word.
    pub name: &'static str,
    /// Section of FMI 2.0; empty where it says nothing.
    pub clause: &'static str,
    /// What is asked.
    pub asks: &'static str,
}

/// The clause of a rule in words.
pub fn clause(name: &str) -> String {
    match RULES.iter().find(|rule| rule.name == name).map(|rule| rule.clause) {
        Some(clause) if !clause.is_empty() => format!("FMI 2.0, {clause}"),
        _ => "no clause of FMI 2.0".into(),
    }
}

const fn rule(name: &'static str, clause: &'static str, asks: &'static str) -> Rule {
    Rule { name, clause, asks }
}

/// All of them.
pub const RULES: &[Rule] = &[
    rule("archive", "2.3", "a zip archive that can be unpacked without danger"),
    rule("no-description", "2.3", "modelDescription.xml at the root of the archive"),
    rule("description", "2.2", "well-formed XML with the elements and attributes that must be there"),
    rule("fmi-version", "2.2.1", "a description for FMI 2"),
    rule("no-co-simulation", "4.3.1", "co-simulation"),
    rule("xml-entities", "", "no entities of its own, which some importers expand without end"),
    rule("guid-empty", "2.2.1", "a GUID"),
    rule("needs-tool", "4.3.1", "to run without another program"),
    rule("experiment", "2.2.5", "a default experiment that ends after it begins"),
    rule("variable", "2.2.7", "causality, variability, type and start value that go together"),
    rule("unit-undefined", "2.2.7", "units that are defined, with or without a base unit"),
    rule("duplicate-name", "2.2.7", "names that occur once"),
    rule("duplicate-reference", "2.2.7", "value references that no two inputs or parameters share"),
    rule("no-binary", "2.3", "a library for this platform"),
    rule("library", "2.3", "a library that is whole and can be loaded"),
    rule("library-beside", "2.3", "other libraries that the loader finds by itself"),
    rule("missing-symbol", "2.1.1", "the functions without which nothing goes"),
    rule("flag-without-symbol", "4.3.1", "the functions that a capability promises"),
    rule("incomplete-library", "2.1.1", "all functions of a co-simulation FMU"),
    rule("no-instance", "2.1.5", "an instance for the right GUID"),
    rule("guid-unchecked", "2.1.5", "no instance for a wrong GUID"),
    rule("resource-uri", "2.1.5", "every form of the resources' URI"),
    rule("logger-call", "2.1.5", "calls of the logger with its environment, names that are there and valid formats"),
    rule("warnings", "2.1.3", "no warning in an ordinary run"),
    rule("discard", "2.1.3", "steps that are done to their end"),
    rule("ends", "4.2.3", "a simulation whose end the master decides"),
    rule("failed", "2.1.3", "calls that succeed"),
    rule("fatal", "2.1.3", "no fatal error"),
    rule("pending", "4.2.2", "steps that are done when the call comes back"),
    rule("crash", "", "not to crash the process"),
    rule("abort", "", "not to abort the process"),
    rule("exit", "", "not to end the process"),
    rule("hang", "", "calls that come back"),
    rule("nan", "", "outputs that are numbers"),
    rule("infinite", "", "outputs that are finite"),
    rule("memory-growth", "", "memory that does not grow with every step"),
    rule("step-jitter", "4.2.2", "steps with rounding noise in time and size"),
    rule("step-halved", "4.3.1", "steps of h/2, where step sizes may vary"),
    rule("step-tiny", "4.2.2", "a step of 1e-17 h, where step sizes may vary"),
    rule("step-elsewhere", "4.2.2", "no step that does not begin where the last one has ended"),
    rule("roll-back", "2.1.8", "a step that repeats after fmi2SetFMUstate"),
    rule("roll-back-first", "2.1.8", "a first step like its repetitions"),
    rule("roll-back-later", "2.1.8", "a state that comes back later in the run, too"),
    rule("roll-back-save", "2.1.8", "a run that saving does not disturb"),
    rule("roll-back-inputs", "2.1.8", "inputs that come back with the state"),
    rule("state-null", "2.1.8", "a state that is not NULL"),
    rule("free-state", "2.1.8", "NULL after fmi2FreeFMUstate"),
    rule("state-leak", "2.1.8", "memory that does not grow with every saved state"),
    rule("serialize", "2.1.8", "the same through bytes, also into another instance"),
    rule("derivatives", "2.1.9", "directional derivatives that are those of the outputs"),
    rule("not-repeatable", "", "the same results in a second run"),
    rule("instances", "2.1.5", "instances that do not disturb each other"),
    rule("reset", "2.1.6", "after fmi2Reset, all as in a fresh instance"),
    rule("prints", "", "nothing on standard output and standard error"),
    rule("writes-files", "", "no files in the current folder"),
    rule("process-state", "", "current folder, signals, limits, floating-point environment as they were"),
    rule("leaves-processes", "2.1.5", "no process that stays"),
];
