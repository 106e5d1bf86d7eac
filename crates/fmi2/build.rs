//! Compiles the logger shim: defining a variadic C function is not possible in stable Rust.

fn main() {
    println!("cargo::rerun-if-changed=src/import/logger.c");
    println!("cargo::rerun-if-changed=src/import/format.h");
    println!("cargo::rerun-if-changed=src/probe/logger.c");
    #[cfg(feature = "import")]
    cc::Build::new()
        .files(["src/import/logger.c", "src/probe/logger.c"])
        .warnings(true)
        .extra_warnings(true)
        .compile("ttb_fmi2_logger");
}
