//! A plugin in C, built here in many ways: right ones give devices, wrong ones a message that says what is wrong.

#[cfg(target_os = "linux")]
mod children;
#[cfg(target_os = "linux")]
mod cpp;
mod devices;
mod estimator;
#[cfg(target_os = "linux")]
mod expiring;
mod fixture;
#[cfg(target_os = "linux")]
mod reach;
mod rejects;
