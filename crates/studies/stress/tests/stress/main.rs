//! Faults of pictures, their severities, and the scores of models with them.

mod bad_input;
mod drawing;
mod pictures;
mod scores;
mod severities;
mod wear;
