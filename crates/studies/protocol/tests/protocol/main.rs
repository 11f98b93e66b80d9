//! Scenes as people write them, and the plans that they become.

mod pruned;
mod scenes;
