//! Describes the joins of tables by an import.

use taceva_core::{counted, shown};
use taceva_dataset::{Header, MappedJoin};

/// Describes each join in the import of a recording, with the number of rows that no sample uses.
pub(super) fn of(header: &Header) -> impl Iterator<Item = String> + '_ {
    header.joins.iter().map(|join| {
        let unused = header.left_out.joined_rows.get(&join.name);
        let unused = unused
            .filter(|count| **count > 0)
            .map(|count| format!("; no sample uses {} of this table", counted(*count, "row")));
        format!("{}{}", words(join), unused.unwrap_or_default())
    })
}

/// Describes a join: `table ft joined by its time stamp: linear between two rows, at most 100 ms away, with a lag of 12.5 ms`.
fn words(join: &MappedJoin) -> String {
    let column = join.column.as_deref().unwrap_or_default();
    let by = match join.by.as_str() {
        "time" => format!("its time {}", shown(column)),
        "columns" => shown(&join.on.join(", ")).to_string(),
        "row" => "row number".to_owned(),
        "until" => format!("the first greater number in {}", shown(column)),
        by => by.to_owned(),
    };
    let pick = join.pick.as_deref().map(|pick| match pick {
        "linear" => "linear between two rows",
        "before" => "the last row before",
        _ => "the nearest row",
    });
    let tolerance = join.tolerance_ms.map(|ms| format!("at most {ms} ms away"));
    let lag = match (&join.lag_by[..], join.lag_ms) {
        ([], None | Some(0.0)) => None,
        ([], Some(ms)) => Some(format!("with a lag of {ms} ms")),
        (by, _) => Some(format!("with a lag by {}", shown(&by.join(", ")))),
    };
    let rules = [pick.map(str::to_owned), tolerance, lag]
        .into_iter()
        .flatten();
    let rules: Vec<String> = rules.collect();
    let colon = if rules.is_empty() { "" } else { ": " };
    format!(
        "table {} joined by {by}{colon}{}",
        shown(&join.name),
        rules.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_join_by_time_states_its_rule_its_tolerance_and_its_lag() {
        let mut join = MappedJoin::new("ft", "time");
        join.column = Some("stamp".to_owned());
        join.pick = Some("linear".to_owned());
        join.tolerance_ms = Some(100.0);
        join.lag_ms = Some(12.5);
        assert_eq!(
            words(&join),
            "table ft joined by its time stamp: linear between two rows, at most 100 ms away, with a lag of 12.5 ms"
        );
        assert_eq!(
            words(&MappedJoin::new("robot", "row")),
            "table robot joined by row number"
        );
    }
}
