//! MB/s (of CPU time) and peak memory of the readers, for a generated file in every format.
//! `cargo bench -p ttb-import`, or with the number of degrees of freedom: `cargo bench -p ttb-import -- 1200000`

use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use ttb_import::{Input, read_matrix};

/// Entries in a column of the lower triangle.
const COLUMN: usize = 30;

type Writer = fn(&mut BufWriter<fs::File>, usize) -> std::io::Result<()>;
const FORMATS: [(&str, Writer); 5] = [
    ("market-lower.mtx", |f, n| market(f, n, false)),
    ("market-full.mtx", |f, n| market(f, n, true)),
    ("triplets.sti", triplets),
    ("labels.txt", labels),
    ("harwell.matrix", harwell),
];

fn main() {
    // Each file is read in a process of its own, so that no memory is there to be used again.
    if let Some(path) = std::env::var_os("TTB_READ") {
        return measure(Path::new(&path));
    }
    let n = std::env::args().find_map(|argument| argument.parse().ok()).unwrap_or(120_000);
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    println!("{n} degrees of freedom, {COLUMN} entries a column");
    for (name, write) in FORMATS {
        let path = folder.join(name);
        let mut file = BufWriter::new(fs::File::create(&path).expect("a file in the target folder"));
        write(&mut file, n).and_then(|()| file.flush()).expect("room in the target folder");
        drop(file);
        let this = std::env::current_exe().expect("this program");
        Command::new(this).env("TTB_READ", &path).status().expect("this program once more");
        fs::remove_file(&path).ok();
    }
}

fn measure(path: &Path) {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let megabytes = fs::metadata(path).map_or(0, |facts| facts.len()) as f64 / 1e6;
    let before = status("VmRSS");
    let (wall, cpu) = (Instant::now(), cpu_seconds());
    let read = read_matrix(&Input::path(path), None, None, None).expect("a good file");
    let (wall, cpu) = (wall.elapsed().as_secs_f64(), cpu_seconds() - cpu);
    let peak = status("VmHWM") - before;
    let result = (read.matrix.entries() * 12 + read.matrix.n * 8) as f64 / 1e6;
    println!(
        "{name:18} {megabytes:7.1} MB  {:9} entries  wall {wall:6.2} s  CPU {cpu:6.2} s  {:6.1} MB/s  \
         result {result:7.1} MB  peak {peak:7.1} MB = {:.2} times the result",
        read.matrix.entries(),
        megabytes / cpu,
        peak / result,
    );
}

/// Of Linux; zero elsewhere. MB.
fn status(key: &str) -> f64 {
    let text = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix(key)).unwrap_or_default();
    line.trim_start_matches(':').trim().trim_end_matches(" kB").parse::<f64>().unwrap_or(0.0) * 1024.0 / 1e6
}

/// User and system time; ticks of 1/100 s.
fn cpu_seconds() -> f64 {
    let text = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = text.rsplit(") ").next().unwrap_or_default();
    fields.split(' ').skip(11).take(2).filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// Rows from 1 below and on the diagonal of a column.
fn rows(j: usize, n: usize) -> impl Iterator<Item = usize> {
    (0..COLUMN).map(move |k| j + k * k).filter(move |i| *i <= n)
}

fn value(i: usize, j: usize) -> f64 {
    if i == j { 5.530_689_102_564_1e10 } else { 1.234_567_890_123_4e9 * (i as f64 * 0.37 + j as f64 * 0.37).sin() }
}

fn market(file: &mut impl Write, n: usize, full: bool) -> std::io::Result<()> {
    let lower: usize = (1..=n).map(|j| rows(j, n).count()).sum();
    let (entries, symmetry) = if full { (2 * lower - n, "general") } else { (lower, "symmetric") };
    writeln!(file, "%%MatrixMarket matrix coordinate real {symmetry}\n{n} {n} {entries}")?;
    for j in 1..=n {
        for i in rows(j, n) {
            writeln!(file, "{i} {j} {:.16e}", value(i, j))?;
            if full && i != j {
                writeln!(file, "{j} {i} {:.16e}", value(i, j))?;
            }
        }
    }
    Ok(())
}

fn triplets(file: &mut impl Write, n: usize) -> std::io::Result<()> {
    (1..=n).try_for_each(|j| rows(j, n).try_for_each(|i| writeln!(file, "{j} {i}  {:.13e}", value(i, j))))
}

fn labels(file: &mut impl Write, n: usize) -> std::io::Result<()> {
    let label = |i: usize| ((i - 1) / 6 + 1, (i - 1) % 6 + 1);
    (1..=n).try_for_each(|j| {
        rows(j, n).try_for_each(|i| {
            let ((a, da), (b, db)) = (label(i), label(j));
            writeln!(file, "{a},{da},{b},{db},{:.15e}", value(i, j))
        })
    })
}

fn harwell(file: &mut impl Write, n: usize) -> std::io::Result<()> {
    let entries: usize = (1..=n).map(|j| rows(j, n).count()).sum();
    writeln!(file, "bench\n{:14}{:14}{entries:14}{entries:14}{:14}", n + 1 + 2 * entries, n + 1, 0)?;
    writeln!(file, "RSA           {n:14}{n:14}{entries:14}{:14}", 0)?;
    writeln!(file, "{:16}{:16}{:20}", "(1I14)", "(1I14)", "(1E25.15)")?;
    let mut pointer = 1;
    for j in 1..=n {
        writeln!(file, "{pointer:14}")?;
        pointer += rows(j, n).count();
    }
    writeln!(file, "{pointer:14}")?;
    (1..=n).try_for_each(|j| rows(j, n).try_for_each(|i| writeln!(file, "{i:14}")))?;
    (1..=n).try_for_each(|j| rows(j, n).try_for_each(|i| writeln!(file, "{:25.15e}", value(i, j))))
}
