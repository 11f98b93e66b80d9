//! Driver `ufactory/xarm`: arms of the xArm family (xArm 5, 6 and 7, 850, Lite 6). It uses the private protocol of their control box.

mod arm;
mod command;
mod error;
mod exchange;
mod expiring;
mod factory;
mod fault;
mod firmware;
mod frame;
mod identity;
mod limits;
mod motion;
mod observe;
mod options;
mod report;
mod stop;
mod watch;

pub use factory::XarmFactory;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("ufactory/xarm");
