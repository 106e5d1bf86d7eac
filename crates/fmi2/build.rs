//! Compiles the logger shim: defining a variadic C function is not possible in stable Rust.

fn main() {
    println!("cargo::rerun-if-changed=src/import/logger.c");
    #[cfg(feature = "import")]
    cc::Build::new().file("src/import/logger.c").warnings(true).extra_warnings(true).compile("ttb_fmi2_logger");
}
