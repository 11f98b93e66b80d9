//! Optional abilities of a device, requested by id.

mod bench;
mod expiring_motion;
mod guarded_motion;
mod reading_number;
mod sensor_lighting;
mod tare;

pub use bench::{BENCH, BenchCalls, Specimen};
pub use expiring_motion::{EXPIRING_MOTION, ExpiringMotionCalls};
pub use guarded_motion::{GUARDED_MOTION, GuardedMotionCalls, GuardedStop};
pub use reading_number::{NUMBERED, NumberedCalls};
pub use sensor_lighting::{SENSOR_LIGHTING, SensorLightingCalls};
pub use tare::{TARE, TareCalls};
