//! Truncated copies of a file, and copies with flipped bits. Reading a copy must give a result or an error of this crate within a minute.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::sync::Once;
use std::time::{Duration, Instant};

thread_local! {
    static PANICKED_AT: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Counts of the results of reading damaged copies.
#[derive(Debug, Default)]
pub(crate) struct Endings {
    pub(crate) read: usize,
    pub(crate) refused: usize,
    /// Number of copies for which a decoder of another crate panicked.
    pub(crate) panicked: usize,
}

/// Reads six truncated copies of the file at `path` and forty copies with flipped bits. `read` gets the path of each damaged copy, which is in a copy
/// of the folder `root`.
///
/// # Panics
/// Panics if the code of this crate panics, or a copy takes longer than sixty seconds.
pub(crate) fn damage<T, E: std::fmt::Display>(
    root: &Path,
    path: &Path,
    endings: &mut Endings,
    read: impl Fn(&Path) -> Result<T, E>,
) {
    let folder = tempfile::tempdir().expect("a folder");
    copy(root, folder.path());
    let relative = path.strip_prefix(root).expect("inside");
    let target = folder.path().join(relative);
    let bytes = std::fs::read(path).expect("readable");
    for (name, copy) in copies(&bytes) {
        std::fs::write(&target, copy).expect("written");
        let start = Instant::now();
        match attempt(|| read(folder.path())) {
            Ok(Ok(_)) => endings.read += 1,
            Ok(Err(error)) => {
                let message = error.to_string();
                // The error may name a file beside it that no longer fits.
                let is_named = message.contains(&*folder.path().to_string_lossy());
                assert!(is_named, "{name}: {message}");
                endings.refused += 1;
            }
            Err(place) => {
                assert!(
                    !place.contains("taceva-tables"),
                    "{name} of {}: {place}",
                    path.display()
                );
                endings.panicked += 1;
            }
        }
        let taken = start.elapsed();
        assert!(
            taken < Duration::from_secs(60),
            "{name} of {}: {taken:?}",
            path.display()
        );
    }
}

/// Result of `read`, or the source file in which it panicked, as an error.
pub(crate) fn attempt<T>(read: impl FnOnce() -> T) -> Result<T, String> {
    listen();
    PANICKED_AT.with_borrow_mut(|at| *at = Some(String::new()));
    let result = panic::catch_unwind(AssertUnwindSafe(read));
    let place = PANICKED_AT.take().unwrap_or_default();
    result.map_err(|_| place)
}

/// Peak memory of this process, bytes; `None` if the system does not report it.
pub(crate) fn peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix(" kB")?.parse().ok()?;
    Some(kibibytes << 10)
}

fn copies(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let length = bytes.len();
    let cuts = [
        1,
        length / 7,
        length / 3,
        length / 2,
        length - length / 8,
        length - 1,
    ];
    let mut copies: Vec<(String, Vec<u8>)> = cuts
        .iter()
        .map(|cut| (format!("cut at {cut}"), bytes[..*cut].to_vec()))
        .collect();
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64 ^ length as u64;
    let mut draw = |below: usize| {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        usize::try_from(seed % below as u64).expect("small")
    };
    for copy in 0..40 {
        let mut flipped = bytes.to_vec();
        // Half of them are where files describe themselves: at the beginning or at the end.
        let within = if copy % 2 == 0 {
            length
        } else {
            length.min(1200)
        };
        for _ in 0..if copy < 20 { 1 } else { 6 } {
            let at = draw(within);
            let at = if copy % 4 == 1 { length - 1 - at } else { at };
            flipped[at] ^= if copy % 3 == 0 { 0xff } else { 1 << draw(8) };
        }
        copies.push((format!("flip {copy}"), flipped));
    }
    copies
}

/// Records the location of a panic in this thread instead of printing the panic.
fn listen() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let loud = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let is_listening = PANICKED_AT.with_borrow_mut(|at| match at {
                Some(place) => {
                    *place = info
                        .location()
                        .map_or_else(String::new, |place| place.file().to_owned());
                    true
                }
                None => false,
            });
            if !is_listening {
                loud(info);
            }
        }));
    });
}

pub(crate) fn copy(from: &Path, to: &Path) {
    for entry in std::fs::read_dir(from).expect("a folder") {
        let entry = entry.expect("an entry");
        let target: PathBuf = to.join(entry.file_name());
        if entry.path().is_dir() {
            std::fs::create_dir(&target).expect("made");
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), &target).expect("copied");
        }
    }
}
