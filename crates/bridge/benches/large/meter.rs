//! Time, memory and bandwidth.

use std::hint::black_box;
use std::time::Instant;

/// Does some work, prints its time and adds its CPU time to `sum`.
pub fn timed<T>(what: &str, sum: &mut f64, work: impl FnOnce() -> T) -> T {
    let (begin, before) = (Instant::now(), cpu());
    let result = work();
    let used = cpu() - before;
    *sum += used;
    println!("{what}: {:.2} s, CPU {used:.2} s", begin.elapsed().as_secs_f64());
    result
}

/// Least seconds of some work.
pub fn least(times: usize, mut work: impl FnMut()) -> f64 {
    let once = || {
        let begin = Instant::now();
        work();
        begin.elapsed().as_secs_f64()
    };
    std::iter::repeat_with(once).take(times).fold(f64::INFINITY, f64::min)
}

/// Least seconds of reading as many numbers once.
pub fn stream(entries: usize) -> f64 {
    let numbers = vec![1.0; entries];
    least(10, || {
        let sums = numbers.chunks_exact(16).fold([0.0; 16], |mut sums: [f64; 16], chunk| {
            (0..16).for_each(|k| sums[k] += chunk[k]);
            sums
        });
        black_box(sums);
    })
}

/// CPU time of this process, s.
fn cpu() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<f64> =
        text.rsplit(')').next().unwrap_or("").split_whitespace().filter_map(|f| f.parse().ok()).collect();
    // After the state letter, which is no number, utime and stime are the 11th and 12th.
    (fields.get(10).unwrap_or(&0.0) + fields.get(11).unwrap_or(&0.0)) / 100.0
}

/// Most memory since the last call, bytes.
pub fn peak_memory() -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap_or("");
    let kilobytes = line.split_whitespace().next().and_then(|n| n.parse::<f64>().ok());
    // 5 resets the peak (proc(5)); where that is not allowed it stays that of the whole run.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    kilobytes.unwrap_or(f64::NAN) * 1024.0
}
