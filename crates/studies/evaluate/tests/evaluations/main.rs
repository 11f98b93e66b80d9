//! Evaluations of whole recordings.

mod angles;
mod division;
mod few_groups;
mod networks;
mod pairing;
mod prediction_check;
mod taxel_drawing;
mod taxels;
mod views;
