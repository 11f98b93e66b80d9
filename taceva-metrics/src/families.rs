//! Families of metrics, each with the sums and the formulas of its metrics.
//!
//! [`Family`](crate::evaluate::family::Family) is the trait of every family. [`channelwise`] serves families with the same sums for
//! each channel, and [`cells`] serves families that compare presses of one contact point and depth. [`row_columns`] gathers selected rows of
//! several columns.

pub(crate) mod accuracy;
pub(crate) mod bias_level;
pub(crate) mod cells;
pub(crate) mod channelwise;
pub(crate) mod clustered_excess;
pub(crate) mod crosstalk;
pub(crate) mod detection;
pub(crate) mod drift;
pub(crate) mod error_limits;
pub(crate) mod hysteresis;
pub(crate) mod idle;
pub(crate) mod inter_sensor;
pub(crate) mod intrinsic;
pub(crate) mod lighting;
pub(crate) mod linearity;
pub(crate) mod repeats;
pub(crate) mod resolution;
pub(crate) mod row_columns;
pub(crate) mod spatial;
pub(crate) mod surface;
pub(crate) mod tolerance;
