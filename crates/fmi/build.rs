//! Compiles the guard around foreign calls: leaving a call by a jump is not possible in Rust.

fn main() {
    println!("cargo::rerun-if-changed=src/guard.c");
    #[cfg(feature = "import")]
    cc::Build::new().file("src/guard.c").warnings(true).extra_warnings(true).compile("ttb_fmi_guard");
}
