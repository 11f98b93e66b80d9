//! The interface, held against what compilers of C and C++ make of its headers.

mod cpp;
mod layout;
