//! What is folded until a reader asks for it; paper shows all of it.

use crate::escape::html;

/// `body` behind `title`, with what it holds in a few words; `id` is a word, `body` HTML.
pub(crate) fn fold(id: &str, title: &str, holds: &str, body: &str) -> String {
    format!(
        "<details class=\"fold\" id=\"{id}\"><summary><span class=\"title\">{}</span> <span class=\"holds\">{}</span></summary>\n{body}\n</details>\n",
        html(title),
        html(holds)
    )
}

/// `1 figure`, `3 figures`.
pub(crate) fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        count => format!("{count} {what}s"),
    }
}
