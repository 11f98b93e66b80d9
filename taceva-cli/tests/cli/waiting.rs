//! Tests that mostly wait: for emulated devices in real time, sandboxes and a cluster.

mod capture;
#[cfg(unix)]
mod interruption;
mod page;
mod plugin_allow;
mod plugin_carousel;
mod plugin_dmx;
mod plugin_line;
mod plugin_serial;
mod practice;
mod rig_check;
mod rig_show;
#[cfg(target_os = "linux")]
mod rig_weight;
mod sweep_slurm;
