//! Sections that a reader unfolds on screen, and that are open in print.

use maud::{Markup, html};

/// Folds `body` behind `title` and `holds`, a short description of the content. `id` is a single word.
pub(crate) fn fold(id: &str, title: &str, holds: &str, body: &Markup) -> Markup {
    html! {
        details.fold #(id) {
            summary { span.title { (title) } " " span.holds { (holds) } } "\n"
            (body)
        } "\n"
    }
}
