//! Comments of a draft on the columns that no line uses.

use std::fmt::Write;

use super::{NAMED, NamedColumn};
use crate::draft::roles::{Role, is_logged};
use taceva_dataset::internal::first_names;

/// Comments on the `columns` that no line of `map` names, and on columns excluded from all channels. `keys` are lines of joins, which name columns of a joined
/// table without its name.
pub(super) fn lists(columns: &[&NamedColumn<'_>], map: &str, keys: &str) -> String {
    let (mut numbers, mut excluded, mut unused) = (Vec::new(), Vec::new(), Vec::new());
    for column in columns {
        let name = &column.name;
        let of_join = name.split_once('.').filter(|_| !column.is_own);
        let own = of_join.map_or(name.as_str(), |(_, own)| own);
        let is_key = !column.is_own && is_in(own, keys);
        // The pandas index has no name.
        let is_used = is_in(name, map) || is_key || is_logged(own) || own.is_empty();
        match column.role {
            Role::Excluded(why) => excluded.push(format!("{name} ({why})")),
            _ if is_used => {}
            Role::Number => numbers.push(name.clone()),
            Role::Numbers(count) => numbers.push(format!("{name} ({count} numbers)")),
            _ => unused.push(name.clone()),
        }
    }
    let mut comments = String::new();
    for (said, names) in [
        ("Numbers with unknown names", numbers),
        ("No channels", excluded),
        ("Not used", unused),
    ] {
        if !names.is_empty() {
            let _ = writeln!(comments, "# {said}: {}", first_names(&names, NAMED));
        }
    }
    comments
}

/// True if `map` names the column: `"name"`, `"name[0]"`, `{name}` or `{name:05}`.
fn is_in(name: &str, map: &str) -> bool {
    let quoted = format!("{name:?}");
    let begun = quoted.strip_suffix('"').unwrap_or(&quoted);
    let forms = [
        quoted.clone(),
        format!("{begun}["),
        format!("{{{name}}}"),
        format!("{{{name}:0"),
    ];
    forms.iter().any(|form| map.contains(form))
}
