//! Sections that are folded on screen until opened, and always open in print.

use maud::{Markup, html};

/// `body` folded behind `title` and a short description of its content; `id` is a single word.
pub(crate) fn fold(id: &str, title: &str, holds: &str, body: &Markup) -> Markup {
    html! {
        details.fold #(id) {
            summary { span.title { (title) } " " span.holds { (holds) } } "\n"
            (body)
        } "\n"
    }
}
