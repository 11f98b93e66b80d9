//! Parts common to many pages: scrolling boxes, table heads, term lists, and filters.

use maud::{Markup, Render, html};

/// Table in a box that scrolls on narrow pages. Screen readers announce `label`.
pub(crate) fn scroll(label: &str, table: &Markup) -> Markup {
    html! { div.scroll tabindex="0" role="group" aria-label=(label) { (table) } "\n" }
}

/// Heads of left-aligned columns.
pub(crate) fn heads<T: Render>(names: impl IntoIterator<Item = T>) -> Markup {
    html! { @for name in names { th scope="col" { (name) } } }
}

/// Heads of right-aligned columns.
pub(crate) fn right_heads<T: Render>(names: impl IntoIterator<Item = T>) -> Markup {
    html! { @for name in names { th.r scope="col" { (name) } } }
}

/// Terms with their descriptions, for a description list.
pub(crate) fn terms<T: Render, U: Render>(entries: impl IntoIterator<Item = (T, U)>) -> Markup {
    html! { @for (term, words) in entries { dt { (term) } dd { (words) } } }
}

/// Filter that shows the rows or cards with the tag of the chosen option. The option `any` shows all.
pub(crate) fn filter<T: Render, U: Render>(
    label: &str,
    any: &str,
    options: impl IntoIterator<Item = (T, U)>,
) -> Markup {
    html! {
        label {
            (label) " "
            select data-filter="tag" {
                option value="" { (any) }
                @for (tag, words) in options { option value=(tag) { (words) } }
            }
        }
    }
}
