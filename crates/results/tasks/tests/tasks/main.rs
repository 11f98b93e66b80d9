//! Scores of tasks beside exact fractions and beside those of other libraries.

mod classes;
mod coverage;
mod golden;
mod laws;
mod other_libraries;
mod probabilities;
mod published;
mod ranking;
mod refused;
mod simulated;
mod top_k;
