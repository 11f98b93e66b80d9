//! The model compared with independent references: closed forms at high precision, a boundary-element solution, published polynomials, and
//! symmetries. Each test states the property and the tolerance.

mod contact;
mod displacement;
mod elastic;
