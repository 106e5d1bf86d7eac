//! However a program ends, its temporary folders go.
#![cfg(all(feature = "import", target_os = "linux"))]

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

struct Ending {
    child: Child,
    output: BufReader<ChildStdout>,
    folder: PathBuf,
    /// What the first folder, and with it the keeper, has cost.
    microseconds: u64,
}

/// Starts the example; it has its folder when this returns.
fn start(how: &str) -> Ending {
    let test = std::env::current_exe().unwrap();
    let program = test.ancestors().nth(2).unwrap().join("examples/endings");
    assert!(program.is_file(), "{} is missing: cargo build -p ttb-fmi --examples", program.display());
    let mut child = Command::new(program).arg(how).stdout(Stdio::piped()).spawn().unwrap();
    let mut output = BufReader::new(child.stdout.take().unwrap());
    let mut line = String::new();
    output.read_line(&mut line).unwrap();
    let (folder, microseconds) = line.trim().rsplit_once(' ').unwrap();
    Ending { child, output, folder: folder.into(), microseconds: microseconds.parse().unwrap() }
}

fn goes(folder: &std::path::Path) -> bool {
    let begin = Instant::now();
    while folder.exists() && begin.elapsed() < Duration::from_secs(10) {
        std::thread::sleep(Duration::from_millis(5));
    }
    !folder.exists()
}

fn signal(process: u32, name: &str) {
    assert!(Command::new("kill").args(["-s", name, &process.to_string()]).status().unwrap().success());
}

#[test]
fn the_owner_and_leave_remove_a_folder_before_the_program_has_ended() {
    for (how, code) in [("return", 0), ("leave", 3)] {
        let mut ending = start(how);
        assert_eq!(ending.child.wait().unwrap().code(), Some(code));
        assert!(!ending.folder.exists(), "{how}");
    }
}

#[test]
fn the_keeper_removes_what_a_program_leaves_behind_that_exits_or_crashes() {
    let mut costs: Vec<u64> = Vec::new();
    for how in ["exit", "abort"] {
        let mut ending = start(how);
        ending.child.wait().unwrap();
        assert!(goes(&ending.folder), "{how}");
        costs.push(ending.microseconds);
    }
    println!("the first folder with the keeper's start: {costs:?} microseconds");
}

#[test]
fn the_keeper_removes_what_a_killed_program_leaves_behind() {
    for name in ["HUP", "INT", "TERM", "KILL"] {
        let mut ending = start("wait");
        assert!(ending.folder.join("inside/file").exists());
        signal(ending.child.id(), name);
        ending.child.wait().unwrap();
        assert!(goes(&ending.folder), "{name}");
    }
}

#[test]
fn a_child_that_holds_the_pipe_open_does_not_keep_the_folder() {
    let mut ending = start("fork");
    let mut child = String::new();
    ending.output.read_line(&mut child).unwrap();
    ending.child.wait().unwrap();
    let gone = goes(&ending.folder);
    signal(child.trim().parse().unwrap(), "KILL");
    assert!(gone);
}

#[test]
fn a_folder_is_for_this_user_alone() {
    use std::os::unix::fs::PermissionsExt;
    let folder = ttb_fmi::temporary::Temporary::new("ttb-test-").unwrap();
    assert_eq!(std::fs::metadata(folder.path()).unwrap().permissions().mode() & 0o777, 0o700);
    let path = folder.path().to_path_buf();
    drop(folder);
    assert!(!path.exists());
}
