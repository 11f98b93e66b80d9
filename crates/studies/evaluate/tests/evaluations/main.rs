//! Evaluations of whole recordings.

mod angles;
mod division;
mod few_groups;
mod networks;
mod pairing;
mod picture_streams;
mod prediction_check;
mod taxel_drawing;
mod taxels;
mod views;
