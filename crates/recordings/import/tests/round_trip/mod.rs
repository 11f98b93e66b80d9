//! What is imported is read back the same, in each way of reading and on any number of threads.

mod gratings;
mod import;
mod presets;
mod stream;

use std::num::NonZeroUsize;

fn jobs(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).expect("at least one")
}
