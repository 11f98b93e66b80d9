//! Models of linfa and smartcore.

mod degenerate;
mod narrow;
mod registered;
mod signals;
