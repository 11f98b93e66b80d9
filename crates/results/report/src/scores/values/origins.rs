//! Comparability of published numbers, by their sources, conditions and definitions.

use crate::results::{Statement, Study, UNSTATED};

/// Explanation of the words on origins, for a note below a table.
pub(super) const LEGEND: &str = "Origins of the published numbers of a row. `one source`: the same source, conditions and definition. \
                                 `other conditions`: one source and definition. `other sources`: one definition. \
                                 `definitions differ`: not comparable, or a source states no definition.";

/// Word on the origins of the published numbers called `quantity`; empty if fewer than two sensors have the number.
pub(super) fn of(studies: &[Study], quantity: &str) -> &'static str {
    let named = |study: &&Study| study.statements.iter().any(|of| of.name == quantity);
    if studies.iter().filter(named).count() < 2 {
        return "";
    }
    let stated = studies.iter().flat_map(|study| &study.statements);
    let stated: Vec<&Statement> = stated.filter(|of| of.name == quantity).collect();
    let is_one = |part: fn(&Statement) -> &str| {
        let mut pairs = stated.windows(2);
        pairs.all(|pair| part(pair[0]) == part(pair[1]))
    };
    let is_one_source = is_one(|of| &of.source);
    let is_stated = stated.iter().all(|of| of.definition != UNSTATED);
    let is_one_definition = is_one(|of| &of.definition) && (is_stated || is_one_source);
    match (
        is_one_definition,
        is_one_source,
        is_one(|of| &of.conditions),
    ) {
        (false, ..) => "definitions differ",
        (true, false, _) => "other sources",
        (true, true, false) => "other conditions",
        (true, true, true) => "one source",
    }
}
