//! Prints the cost of long work before its start: time to read pictures, and disk space for features.

use std::path::Path;
use std::time::{Duration, Instant};

use taceva_core::counted;
use taceva_dataset::Dataset;
use taceva_evaluate::{Cache, Effort};

use super::Context;
use crate::amount::bytes;
use crate::disk_space;
use crate::progress::spoken;

/// Minimum duration of work whose cost is printed.
const LONG: Duration = Duration::from_secs(5);
/// Minimum number of written bytes of work whose cost is printed.
const MUCH: u64 = 50_000_000;
/// Number of pictures above which time is estimated.
const MANY: usize = 200;
/// Number of pictures that are read for an estimate.
const TRIED: usize = 4;

/// Prints the cost of `effort` on `dataset`, if the cost is large.
pub(super) fn print(effort: &Effort, dataset: &Dataset, cache: Option<&Cache>, context: &Context) {
    let time = time_of(&effort.rows, dataset, context.jobs.get());
    let kept = cache.map_or(0, |_| effort.kept_bytes);
    let free = cache.and_then(|cache| disk_space::free(cache.path()));
    let folder = cache.map_or(Path::new("."), Cache::path);
    for line in lines(effort.rows.len(), time, kept, free, folder) {
        context.say(format_args!("{line}"));
    }
}

/// Estimated time to read the pictures of `rows`. `None` for few pictures, or if a sample cannot be read; the work itself reports this error.
fn time_of(rows: &[usize], dataset: &Dataset, jobs: usize) -> Option<Duration> {
    if rows.len() < MANY {
        return None;
    }
    let tried = rows.iter().step_by(rows.len() / TRIED).take(TRIED);
    let begun = Instant::now();
    let mut count = 0_u32;
    for row in tried {
        dataset.frame(*row).ok()?;
        count += 1;
    }
    let each = begun.elapsed() / count.max(1);
    let all = u32::try_from(rows.len().div_ceil(jobs.max(1))).ok()?;
    each.checked_mul(all)
}

/// Lines that state the time and the disk space of the work, if they are large.
fn lines(
    frames: usize,
    time: Option<Duration>,
    kept: u64,
    free: Option<u64>,
    folder: &Path,
) -> Vec<String> {
    let time = time.filter(|time| *time >= LONG).map(|time| {
        format!(
            "time: about {} to read {} whose features are not in the cache; training then reports its own progress",
            spoken(time),
            counted(frames, "picture")
        )
    });
    let room = (kept >= MUCH).then(|| {
        let free = free.map_or_else(String::new, |free| {
            let fits = if free < kept {
                ": if they do not fit, they are not stored"
            } else {
                ""
            };
            format!(", {} are free{fits}", bytes(free))
        });
        format!(
            "disk: {} of features to store in {}{free}; --no-cache stores none",
            bytes(kept),
            taceva_core::shown(folder)
        )
    });
    time.into_iter().chain(room).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn much_is_said_and_little_is_not() {
        let folder = Path::new("/cache");
        let said = lines(9, Some(Duration::from_secs(4)), 1_000, Some(10), folder);
        assert_eq!(said, Vec::<String>::new());
        let said = lines(
            20_000,
            Some(Duration::from_secs(130)),
            80_000_000,
            Some(1_500_000_000),
            folder,
        );
        assert_eq!(
            said,
            [
                "time: about 3 min to read 20000 pictures whose features are not in the cache; training then reports its own progress",
                "disk: 80.0 MB of features to store in /cache, 1.50 GB are free; --no-cache stores none",
            ]
        );
        let said = lines(1, Some(Duration::from_secs(130)), 0, None, folder);
        assert!(said[0].contains("to read 1 picture whose"), "{said:?}");
        let said = lines(9, None, 80_000_000, Some(10_000), folder);
        assert!(
            said[0].contains("10.0 kB are free: if they do not fit"),
            "{said:?}"
        );
    }
}
