#![doc = include_str!("../README.md")]

mod access;
mod error;
mod frames;
mod live;
mod operator;
mod overlay;
mod page;
mod picture;
mod request;
mod response;
mod route;
mod sight;
mod state;
mod strangers;
mod token;

pub use error::PageError;
pub use live::{Live, Open};
pub use operator::PageOperator;
pub use overlay::{Overlay, PredictedValue};
pub use page::Page;
pub use state::{Limits, Place, PlaceState, PredictedFrames};
