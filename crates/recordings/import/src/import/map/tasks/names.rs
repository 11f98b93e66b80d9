//! Checks the names of classes, and the limits of pose changes.

use std::collections::BTreeSet;

use taceva_core::{Nanometre, nearest};

use crate::import::map::ClassMap;
use taceva_dataset::TaskKind;
use taceva_dataset::internal::{listed, shown};

/// Maximum number of classes of a task, and maximum length of a class name, bytes. The header contains all names.
const NAMES: usize = 4_096;
const NAME_BYTES: usize = 128;

/// Text for an error that lists `names` and suggests the name nearest to `wrong`.
pub(crate) fn no_name(wrong: &str, names: &[String]) -> String {
    let guess = nearest(wrong, names.iter().map(String::as_str));
    let guess = guess.map_or_else(
        || "; its names are".to_owned(),
        |guess| format!(", did you mean `{}`? Its names are", shown(guess)),
    );
    format!("no name of the task{guess} {}", listed(names))
}

/// Problem with the class names of a task; `None` if the names are usable.
pub(super) fn problem_of_names(class: &ClassMap, kind: TaskKind) -> Option<String> {
    let names = &class.names;
    let mut seen = BTreeSet::new();
    if !(2..=NAMES).contains(&names.len()) {
        return Some(format!(
            "`names` has {}, expected 2 to {NAMES}: name every class that a model can predict",
            taceva_core::counted(names.len(), "class")
        ));
    }
    if let Some(twice) = names.iter().find(|name| !seen.insert(name.as_str())) {
        return Some(format!("`names` has `{}` twice", shown(twice)));
    }
    let is_wrong =
        |name: &&String| name.is_empty() || name.trim() != *name || name.len() > NAME_BYTES;
    if let Some(wrong) = names.iter().find(is_wrong) {
        return Some(format!(
            "the name `{}` is empty, begins or ends with a blank, or is longer than {NAME_BYTES} bytes",
            shown(wrong)
        ));
    }
    if kind != TaskKind::Class && names.len() != 2 {
        return Some(format!(
            "a task of kind `{}` needs two names, such as [\"no_slip\", \"slip\"], found {}: write `kind = \"class\"` for more",
            kind.name(),
            names.len()
        ));
    }
    let (name, position) = class.ambiguous()?;
    let other = names.get(position).map_or("", String::as_str);
    Some(format!(
        "the name `{0}` is also the position of `{1}`, so a cell `{0}` is ambiguous: use names that are not positions, such as `class {0}`",
        shown(name),
        shown(other)
    ))
}

/// Problem with limits of a pose change, which are positive decimals in ascending order.
pub(super) fn problem_of_limits(limits: &[String]) -> Option<String> {
    if limits.is_empty() {
        let problem = "`thresholds` needs `t`, limits of translations in mm, and `r`, limits of rotations in degrees";
        return Some(problem.to_owned());
    }
    let mut before = Nanometre(0);
    for limit in limits {
        let number = limit.parse::<Nanometre>().ok();
        match number.filter(|number| *number > before) {
            Some(number) => before = number,
            None => {
                return Some(format!(
                    "`thresholds` has `{}`, expected decimals in ascending order above 0, such as [\"0.1\", \"0.5\", \"1\"], with at most six decimal places",
                    shown(limit)
                ));
            }
        }
    }
    None
}
