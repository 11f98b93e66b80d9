//! The page over its socket: accepted and rejected clients, and no waiting for slow clients.

mod access;
mod display;
mod support;
