//! Scores of tasks, compared with exact fractions and with scores of other libraries.

mod as_published;
mod cases;
mod classes;
mod coverage;
mod depth;
mod events;
mod golden;
mod laws;
mod other_libraries;
mod pose;
mod probabilities;
mod published;
mod ranking;
mod refused;
mod shape;
mod simulated;
mod state;
mod stored;
mod top_k;
