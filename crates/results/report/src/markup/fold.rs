//! Passages that are folded on the screen until a reader opens them, and always open on paper.

use maud::{Markup, html};

/// `body` behind `title`, with what it holds in a few words; `id` is a word.
pub(crate) fn fold(id: &str, title: &str, holds: &str, body: &Markup) -> Markup {
    html! {
        details.fold #(id) {
            summary { span.title { (title) } " " span.holds { (holds) } } "\n"
            (body)
        } "\n"
    }
}

/// `1 figure`, `3 figures`.
pub(crate) fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        count => format!("{count} {what}s"),
    }
}
