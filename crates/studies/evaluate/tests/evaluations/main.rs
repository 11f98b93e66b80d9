//! Evaluations of whole recordings.

mod division;
mod networks;
mod pairing;
mod taxel_drawing;
mod taxels;
