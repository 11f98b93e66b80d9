//! External libraries read an exported dataset correctly. Imported again by the map beside it, the dataset is the same: ids, labels to the last
//! bit, signals, origin, pixels.

mod card;
mod drawn;
mod libraries;
mod refused;
mod round_trip;
