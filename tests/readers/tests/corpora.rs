//! Every reader over its corpus and over mutations of it, the same ones each time.
//!
//! `TTB_FUZZ=100000 cargo test --release -p ttb-readers` for more than the short round. A failure names what it was given;
//! the bytes are then in `target/tmp`.

use std::path::{Path, PathBuf};

use ttb_readers::{TARGETS, Target};

/// Mutations of every file of a corpus in the short round.
const ROUNDS: usize = 25;

/// xorshift64.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % bound.max(1) as u64) as usize
    }
}

/// What files are broken with, besides single bytes.
const WORDS: [&[u8]; 24] = [
    b"0",
    b"1",
    b"-1",
    b"9",
    b"1e308",
    b"1e-320",
    b"1e999",
    b"nan",
    b"null",
    b"true",
    b"9223372036854775808",
    b"4294967296",
    b"1000000",
    b"[]",
    b"{}",
    b"\"",
    b",",
    b"\n",
    b" ",
    b"\0",
    b"\xff\xfe",
    b"<",
    b"&#x1b;",
    b"-",
];

/// Between one and four changes.
fn mutated(file: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len() + 1);
        let to = (at + random.below(16)).min(bytes.len());
        let word = WORDS[random.below(WORDS.len())].iter().copied();
        match random.below(6) {
            0 => drop(bytes.drain(at..to)),
            1 => bytes[at..to].iter_mut().for_each(|byte| *byte = random.below(256) as u8),
            2 => drop(bytes.splice(at..at, word)),
            3 => {
                // A number becomes another.
                let digits: Vec<usize> = (0..bytes.len()).filter(|i| bytes[*i].is_ascii_digit()).collect();
                if let Some(at) = digits.get(random.below(digits.len())) {
                    drop(bytes.splice(*at..=*at, word));
                }
            }
            4 => {
                let piece = bytes[at..to].to_vec();
                let times = 1 + random.below(20);
                drop(bytes.splice(at..at, piece.repeat(times)));
            }
            _ => bytes.truncate(if random.below(8) == 0 { at } else { bytes.len() }),
        }
    }
    bytes
}

fn corpus(name: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(name);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), std::fs::read(path).expect("a file"))).collect()
}

/// Calls a target; should it panic, the bytes are kept.
fn call((name, target): Target, bytes: &[u8], of: &Path) {
    if std::panic::catch_unwind(|| target(bytes)).is_err() {
        let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.failed"));
        std::fs::write(&kept, bytes).expect("a place for the bytes");
        panic!("{name}, from {}: what it was given is in {}", of.display(), kept.display());
    }
}

#[test]
fn no_reader_breaks_on_its_corpus_nor_on_mutations_of_it() {
    let rounds = std::env::var("TTB_FUZZ").ok().and_then(|text| text.parse().ok()).unwrap_or(ROUNDS);
    for target in TARGETS {
        let (begun, mut count) = (std::time::Instant::now(), 0);
        for (path, file) in corpus(target.0) {
            call(target, &file, &path);
            let mut random = Random(0x9E37_79B9_7F4A_7C15 ^ file.len() as u64);
            for _ in 0..rounds {
                call(target, &mutated(&file, &mut random), &path);
            }
            count += 1 + rounds;
        }
        println!("{}: {count} inputs in {:.2} s", target.0, begun.elapsed().as_secs_f64());
        assert!(count > rounds, "{} has a corpus", target.0);
    }
}

#[test]
fn what_fuzzing_found_stays_mended() {
    // Inputs that once broke a reader, by the name of their target.
    for target in TARGETS {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("found").join(target.0);
        for entry in std::fs::read_dir(folder).into_iter().flatten() {
            let path = entry.expect("an entry").path();
            call(target, &std::fs::read(&path).expect("a file"), &path);
        }
    }
}
