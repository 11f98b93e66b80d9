//! Tests that imported data is read back unchanged, by each reader and on any number of threads.

mod gratings;
mod import;
mod presets;
mod stream;

use std::num::NonZeroUsize;

fn jobs(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).expect("at least one")
}
