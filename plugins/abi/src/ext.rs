//! Abilities that a device may have: asked for by id, absent by default.

mod bench;
mod expiring_motion;
mod guarded_motion;
mod numbered;
mod sensor_lighting;
mod tare;

pub use bench::{BENCH, BenchCalls, Specimen};
pub use expiring_motion::{EXPIRING_MOTION, ExpiringMotionCalls};
pub use guarded_motion::{GUARDED_MOTION, GuardedMotionCalls, GuardedStop};
pub use numbered::{NUMBERED, NumberedCalls};
pub use sensor_lighting::{SENSOR_LIGHTING, SensorLightingCalls};
pub use tare::{TARE, TareCalls};
