//! Names of views: several names in one text, and messages about missing views.

use crate::text::shown;

/// Separator between the names of views placed side by side.
pub(crate) const BESIDE: char = '+';

/// Error message for a view that does not exist, or for a missing selection.
pub(crate) fn wanted_view(asked: Option<&str>, known: &[String]) -> String {
    let quoted = |name: &String| format!("`{}`", shown(name));
    let names: Vec<String> = known.iter().map(quoted).collect();
    let both = known.join(&BESIDE.to_string());
    match (asked, known) {
        (None, _) => format!(
            "each sample has several pictures, the views {}; choose one by `--view {}`, or several side by side by `--view {both}`",
            names.join(", "),
            known.first().map_or("NAME", String::as_str)
        ),
        (Some(asked), []) => format!(
            "no view `{}`: each sample has one picture, without a name; leave out the view",
            shown(asked)
        ),
        (Some(asked), _) => format!(
            "no view `{}`, expected one of {}, or several side by side: `{both}`",
            shown(asked),
            names.join(", ")
        ),
    }
}
