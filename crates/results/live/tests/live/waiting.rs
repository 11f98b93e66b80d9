//! The page over its socket: who is let in, who is refused, and that nobody is waited for.

mod access;
mod display;
mod support;
