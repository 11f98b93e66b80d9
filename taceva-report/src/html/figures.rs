//! The figures of a report, each with what a reader must know.

use crate::escape::html;
use crate::figure::Figure;

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
