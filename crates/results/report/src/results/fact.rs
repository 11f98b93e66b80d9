//! Properties of a sensor other than scores.

/// Published property of a sensor other than a score, such as its size or price. Tables show facts next to scores. Facts are never compared.
///
/// ```
/// let digit = taceva_report::catalogue::find("DIGIT").expect("there").as_study();
/// let size = digit.facts.iter().find(|fact| fact.name == "size").expect("known");
/// assert_eq!((size.value.as_str(), size.unit.as_str()), ("20 × 27 × 18", "mm"));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Fact {
    /// Name of the property: `size`, `price`, `cost of parts`.
    pub name: String,
    /// Unit; empty for text, or if the value contains the unit.
    pub unit: String,
    /// Value as published, with `≈`, `>` or `<` if inexact.
    pub value: String,
}
