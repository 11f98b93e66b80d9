//! Tests of scenes and their plans.

mod pruned;
mod scenes;
