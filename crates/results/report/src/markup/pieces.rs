//! Parts that many pages have: boxes that scroll, heads of tables, lists of terms, and filters.

use maud::{Markup, Render, html};

/// A table in a box that scrolls where the page is too narrow for it; `label` is its name for those who do not see it.
pub(crate) fn scroll(label: &str, table: &Markup) -> Markup {
    html! { div.scroll tabindex="0" role="group" aria-label=(label) { (table) } "\n" }
}

/// Heads of columns whose cells stand to the left.
pub(crate) fn heads<T: Render>(names: impl IntoIterator<Item = T>) -> Markup {
    html! { @for name in names { th scope="col" { (name) } } }
}

/// Heads of columns whose cells stand to the right.
pub(crate) fn right_heads<T: Render>(names: impl IntoIterator<Item = T>) -> Markup {
    html! { @for name in names { th.r scope="col" { (name) } } }
}

/// Terms with what is said of each, as they stand in a list of them.
pub(crate) fn terms<T: Render, U: Render>(entries: impl IntoIterator<Item = (T, U)>) -> Markup {
    html! { @for (term, words) in entries { dt { (term) } dd { (words) } } }
}

/// A choice of which rows or cards the page shows, those with the tag of the chosen option; `any` is the option of all.
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
