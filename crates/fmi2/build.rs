//! Compiles the logger shim: defining a variadic C function is not possible in stable Rust.

fn main() {
    println!("cargo::rerun-if-changed=src/logger/logger.c");
    println!("cargo::rerun-if-changed=src/logger/format.h");
    #[cfg(feature = "import")]
    cc::Build::new().file("src/logger/logger.c").warnings(true).extra_warnings(true).compile("ttb_fmi2_logger");
}
