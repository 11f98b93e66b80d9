//! Tests of the page over its socket: accepted and rejected clients, and slow clients that nothing waits for.

mod access;
mod display;
mod support;
