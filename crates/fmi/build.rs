//! Compiles the guard around foreign calls: leaving a call by a jump is not possible in Rust.

fn main() {
    for file in ["guard.c", "guard_windows.c", "control.h"] {
        println!("cargo::rerun-if-changed=src/guard/{file}");
    }
    #[cfg(feature = "import")]
    {
        let windows = std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "windows");
        let file = if windows { "src/guard/guard_windows.c" } else { "src/guard/guard.c" };
        cc::Build::new().file(file).warnings(true).extra_warnings(true).compile("ttb_fmi_guard");
    }
}
