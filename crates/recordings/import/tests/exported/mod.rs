//! A dataset that is exported is what the libraries of other people read, and imported again by the map beside it, it is the same: ids, labels to the
//! last bit, signals, origin, pixels.

mod drawn;
mod libraries;
mod refused;
mod round_trip;
