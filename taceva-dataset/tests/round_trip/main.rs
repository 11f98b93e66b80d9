//! What goes in comes out, whichever way and on however many threads.

mod gratings;
mod import;
#[path = "../lab/mod.rs"]
mod lab;
mod presets;
mod stream;

use std::num::NonZeroUsize;

fn jobs(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).expect("at least one")
}
