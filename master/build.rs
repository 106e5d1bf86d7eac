//! Makes `_exit` and its like of the guard around foreign calls (`ttb_fmi::guard`) visible to libraries that are loaded later.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux") {
        for name in ["_exit", "_Exit", "pthread_exit"] {
            println!("cargo::rustc-link-arg-bins=-Wl,--export-dynamic-symbol={name}");
        }
    }
}
