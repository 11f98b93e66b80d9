//! Faults of pictures, their severities, and the scores of models with them.

mod bad_input;
mod bench_monitor;
mod drawing;
mod foreign;
mod golden;
mod monitor;
mod pictures;
mod scores;
mod severities;
mod wear;
