//! The interface, compared with its headers as C and C++ compilers see them.

mod cpp;
mod layout;
