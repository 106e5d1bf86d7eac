//! FMI 2.0 co-simulation, export and import.
