//! The program that isolated FMUs of the tests run in.

fn main() -> Result<(), String> {
    ttb_fmi2::import::host()
}
