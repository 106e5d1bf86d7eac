//! The verbs of `ttb`, a file or folder each.

pub mod accuracy;
pub mod build;
pub mod campaign;
pub mod check;
pub mod check_scenario;
pub mod compare;
pub mod export_ssp;
pub mod generate;
pub mod help_files;
pub mod host;
pub mod inspect;
pub mod inspect_bridge;
pub mod interoperability;
pub mod keeper;
mod limits;
pub mod list;
mod listed;
pub mod new;
mod output;
mod progress;
pub mod report;
pub mod run;
pub mod schema;
pub mod signature;
pub mod statics;
pub mod sweep;
pub mod view;
