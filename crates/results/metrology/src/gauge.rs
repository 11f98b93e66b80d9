//! Gauge studies: components of variance of a measuring system.
