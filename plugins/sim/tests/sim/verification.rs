//! The model against references that were worked out elsewhere: closed forms at high precision, a boundary-element solution, published
//! polynomials and the algebra of symmetry. Each test says which property it holds to which tolerance.

mod contact;
mod displacement;
mod elastic;
