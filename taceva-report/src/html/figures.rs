//! The figures of a report, each with what a reader must know.

use crate::escape::html;
use crate::figure::Figure;

pub(super) fn section(figures: &[Figure]) -> String {
    if figures.is_empty() {
        return "<p>There is nothing to draw: no score has a map or a curve, and the samples are not at hand.</p>".to_owned();
    }
    let mut out = String::from(
        "<p class=\"note\">Point at a mark for its value and n, or step through the marks of a figure with the arrow keys.</p>\n",
    );
    for figure in figures {
        out += &one(figure);
    }
    out
}

/// A figure with its title and caption.
pub(crate) fn one(figure: &Figure) -> String {
    format!(
        "<figure id=\"figure-{}\"><h3>{}</h3>\n{}<figcaption>{}</figcaption></figure>\n",
        html(&figure.id),
        html(&figure.title),
        figure.inline(),
        html(&figure.caption)
    )
}
