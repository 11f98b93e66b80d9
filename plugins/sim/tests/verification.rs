//! The model against references that were worked out elsewhere: closed forms at high precision, a boundary-element solution, published
//! polynomials and the algebra of symmetry. Each test says which property it holds to which tolerance.

#[path = "verification/contact.rs"]
mod contact;
#[path = "verification/displacement.rs"]
mod displacement;
#[path = "verification/elastic.rs"]
mod elastic;
