//! Tests that cross crates, in one program.

mod additions;
mod book;
mod circles;
mod damage;
mod damaged_jpegs;
mod disk_fault;
mod disk_full;
mod documents;
mod embedding;
mod file_tree;
mod flips;
mod foretold_names;
mod glossary;
mod kill;
mod kill_commands;
mod kill_training;
mod layering;
mod minimum_rust;
#[cfg(target_os = "linux")]
mod plugin_equivalence;
mod power_cut;
mod power_cut_self;
mod public_types;
#[cfg(unix)]
mod recording_links;
mod recordings;
#[cfg(unix)]
mod release;
mod reports;
mod skips;
mod source_digests;
mod structure;
mod study;
mod taxels;
#[cfg(target_os = "linux")]
mod temporary_directory;
mod waiting;
mod wire_faults;
