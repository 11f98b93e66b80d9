//! Tests of the page: over its socket, and in a real browser.

mod browser;
mod waiting;
