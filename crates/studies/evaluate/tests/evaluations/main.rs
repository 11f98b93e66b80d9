//! Evaluations of whole recordings.

mod networks;
mod taxel_drawing;
mod taxels;
