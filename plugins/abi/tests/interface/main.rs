//! Compares the interface in Rust with its headers, compiled as C and C++.

mod cpp;
mod layout;
