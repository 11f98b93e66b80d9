//! Families of metrics, one folder or file each: what is kept of the samples, and the formulas that are finished from it.
//!
//! [`Family`](crate::evaluate::family::Family) says what every family implements, [`channelwise`] what those that keep the same of each channel share, [`cells`] what those
//! that compare presses of one contact point and depth keep, [`gathered`] how some rows of several columns come side by side.

pub(crate) mod accuracy;
pub(crate) mod bias_level;
pub(crate) mod cells;
pub(crate) mod channelwise;
pub(crate) mod clustered_excess;
pub(crate) mod crosstalk;
pub(crate) mod drift;
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
