//! A C plugin, built in many variants. Valid ones give devices; invalid ones give an error that names the fault.

#[cfg(target_os = "linux")]
mod children;
#[cfg(target_os = "linux")]
mod cpp;
mod devices;
mod estimator;
#[cfg(target_os = "linux")]
mod expiring;
mod fixture;
mod frames;
#[cfg(target_os = "linux")]
mod reach;
mod rejects;
