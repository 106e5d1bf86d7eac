//! A program with a temporary folder that ends as it is told; what the test of temporary folders starts.

use std::io::Write;
use ttb_fmi::temporary::{self, Temporary};

fn main() -> std::io::Result<()> {
    let how = std::env::args().nth(1).unwrap_or_default();
    if how == "keep" {
        return temporary::keep();
    }
    temporary::keeper(std::env::current_exe()?, vec!["keep".into()]);
    let begin = std::time::Instant::now();
    let folder = Temporary::new("ttb-test-")?;
    let first = begin.elapsed();
    std::fs::create_dir(folder.path().join("inside"))?;
    std::fs::write(folder.path().join("inside/file"), "content")?;
    println!("{} {}", folder.path().display(), first.as_micros());
    std::io::stdout().flush()?;
    match how.as_str() {
        "return" => drop(folder),
        "leave" => ttb_fmi::leave(3),
        "exit" => std::process::exit(0),
        "abort" => std::process::abort(),
        "fork" => {
            // A child that outlives this process and holds all its files, the keeper's pipe among them.
            unsafe extern "C" {
                fn fork() -> i32;
                fn pause() -> i32;
            }
            // SAFETY: no other thread runs here, and the child does nothing but wait.
            unsafe {
                let child = fork();
                if child == 0 {
                    pause();
                }
                println!("{child}");
            }
            std::io::stdout().flush()?;
            std::process::abort();
        }
        _ => std::thread::sleep(std::time::Duration::from_secs(30)),
    }
    Ok(())
}
