//! Tests that external libraries read an exported dataset correctly. A second import with the map of the export must give the same ids, labels to the last bit,
//! signals, origin and pixels.

mod card;
mod drawn;
mod libraries;
mod refused;
mod round_trip;
