//! Tests of the page over its socket: accepted, rejected and slow clients. Slow clients delay no other client.

mod access;
mod display;
mod support;
