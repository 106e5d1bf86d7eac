//! TrainTrack.fmu: the train–track subsystem behind the FMI 2.0 shell.
//!
//! Inputs are displacement and velocity of the bridge under each support, outputs the support forces and the results of
//! train, wheels and rail; the physics is [`ttb_train_track::TrainTrack`], the C interface [`ttb_fmi2::export`].
//! Resources are read once, in `fmi2Instantiate`.
//!
//! Nothing may link this crate into another program: both FMUs export the same C symbols. The packed FMU renames the
//! shared library to its model identifier, `TrainTrack.so`.

ttb_fmi2::export_fmu!(ttb_train_track::TrainTrack, "TrainTrack");
