//! Tests of the whole crate: laws, golden values, references and hostile input.

#![expect(clippy::print_stdout, reason = "says how many values were compared")]
#![cfg_attr(
    not(all(feature = "bench", feature = "serde")),
    allow(dead_code, reason = "what the features bring uses the rest of it")
)]

mod bootstrap;
#[cfg(feature = "serde")]
mod cells_laws;
mod comparison;
mod comparison_laws;
mod comparison_trainings;
mod coverage;
mod embedding;
mod exact_sum;
#[cfg(feature = "serde")]
mod family_laws;
#[cfg(feature = "serde")]
mod family_values;
#[cfg(feature = "bench")]
mod fifty_digits;
#[cfg(feature = "bench")]
mod golden;
mod holm;
mod ideal;
mod isa;
#[cfg(feature = "serde")]
mod merge_laws;
#[cfg(feature = "serde")]
mod paper_values;
mod periods;
mod ranges;
mod scaling;
mod standing;
#[cfg(feature = "bench")]
mod strd;
#[cfg(all(feature = "bench", feature = "serde"))]
mod stress;
#[cfg(feature = "serde")]
mod structured;
#[cfg(feature = "serde")]
mod structured_cells;
mod support;
mod unbiased;
mod undefined_cells;
#[cfg(feature = "serde")]
mod undefined_values;
mod whole_families;
