//! Scores of tasks beside exact fractions and beside those of other libraries.

mod cases;
mod classes;
mod depth;
mod events;
mod pose;
mod shape;
