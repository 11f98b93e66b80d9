//! Names of views: several of them in one text, and what is said where one is missing.

use crate::text::shown;

/// Stands between the names of views whose pictures are put side by side.
pub(crate) const BESIDE: char = '+';

/// Reason why a view is not there, or none is meant, in words.
pub(crate) fn wanted_view(asked: Option<&str>, known: &[String]) -> String {
    let quoted = |name: &String| format!("`{}`", shown(name));
    let names: Vec<String> = known.iter().map(quoted).collect();
    let both = known.join(&BESIDE.to_string());
    match (asked, known) {
        (None, _) => format!(
            "each sample has several pictures, the views {}, and none was named: `--view {}` takes one, `--view {both}` puts them side by side",
            names.join(", "),
            known.first().map_or("NAME", String::as_str)
        ),
        (Some(asked), []) => format!(
            "no view `{}`: each sample has one picture, without a name; leave the view out",
            shown(asked)
        ),
        (Some(asked), _) => format!(
            "no view `{}`, expected one of {}, or several side by side: `{both}`",
            shown(asked),
            names.join(", ")
        ),
    }
}
