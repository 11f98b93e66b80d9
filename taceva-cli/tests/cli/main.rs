//! The program `taceva`, run as by a user.
//!
//! Modules whose tests mostly wait, for emulated devices in real time or a cluster, are below [`waiting`].

mod bench_models;
mod cache;
mod cache_list;
mod directions;
mod division;
mod exported;
mod extended;
mod features;
mod foreign_forms;
mod gratings;
mod guide;
mod help;
mod init;
mod journey;
mod library_models;
mod plan;
mod plugin;
mod plugin_check;
mod plugin_journey;
mod plugin_models;
mod plugin_pack;
mod presets;
mod recomputed;
mod refusals;
mod remedies;
mod report;
mod rig;
mod run;
mod schema;
mod seals;
mod several;
mod shards;
mod shared_work;
mod skill;
mod support;
mod sweep;
mod sweep_scenes;
mod sweep_tables;
mod taxels;
mod threads;
mod uncertainty;
mod views;
mod waiting;
mod words;
