//! Random numbers, and contents of folders, for the tests of recordings.

use std::fs;
use std::path::{Path, PathBuf};

use taceva_core::random::SplitMix64;

/// Relative paths of all files below a folder, sorted, with their content.
pub(crate) fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(current) = folders.pop() {
        for entry in fs::read_dir(&current).expect("listed") {
            let path = entry.expect("listed").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let relative = path.strip_prefix(folder).expect("below").to_owned();
                found.push((relative, fs::read(&path).expect("read")));
            }
        }
    }
    found.sort();
    found
}

/// Random numbers that are the same in each run.
pub(crate) struct Random(SplitMix64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(SplitMix64::new(seed))
    }

    pub(crate) fn below(&mut self, limit: usize) -> usize {
        usize::try_from(self.0.next_u64() % limit as u64).expect("below a usize")
    }

    /// Copy of `bytes` with a few random changes: overwritten, truncated, doubled or removed parts.
    pub(crate) fn mutated(&mut self, bytes: &[u8]) -> Vec<u8> {
        let mut changed = bytes.to_vec();
        for _ in 0..=self.below(4) {
            if changed.is_empty() {
                break;
            }
            let at = self.below(changed.len());
            match self.below(5) {
                0 => changed[at] ^= 1 << self.below(8),
                1 => changed[at] = self.below(256).to_le_bytes()[0],
                2 => changed.truncate(at),
                3 => {
                    changed.remove(at);
                }
                _ => {
                    let end = (at + 1 + self.below(9)).min(changed.len());
                    let piece = changed[at..end].to_vec();
                    changed.splice(at..at, piece);
                }
            }
        }
        changed
    }
}
