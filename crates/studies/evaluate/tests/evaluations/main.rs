//! Evaluations of whole recordings.

mod networks;
mod pairing;
mod taxel_drawing;
mod taxels;
