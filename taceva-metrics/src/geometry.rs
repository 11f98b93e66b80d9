//! Points in the plane and in space: exact convex hulls, and registration of point clouds.

mod growing_hull;
mod hull;
mod hull_core;
mod nearest;
mod orientation;
mod registration;
mod rigid;

pub(crate) use growing_hull::GrowingHull;
pub(crate) use hull::Hull;
pub use nearest::{Nearest, NearestPoints};
pub(crate) use registration::{Registration, register_clouds};
pub(crate) use rigid::{Motion, Point};
