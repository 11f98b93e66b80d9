//! The figures of a report, each with what a reader must know.

use maud::{Markup, PreEscaped, html};

use crate::figure::Figure;

/// A figure with its title and caption.
pub(crate) fn one(figure: &Figure) -> Markup {
    html! {
        figure id={ "figure-" (figure.id) } { h3 { (figure.title) } "\n" (drawing(figure)) figcaption { (figure.caption) } } "\n"
    }
}

/// A figure alone.
pub(super) fn drawing(figure: &Figure) -> Markup {
    // SVG is XML, whose empty elements end otherwise than those of HTML; its writer escapes every word.
    PreEscaped(figure.inline())
}

/// The radars among `figures` side by side; `None` where there is none.
pub(crate) fn radars(figures: &[Figure]) -> Option<Markup> {
    let radars: Vec<&Figure> = figures.iter().filter(|drawn| is_radar(drawn)).collect();
    (!radars.is_empty())
        .then(|| html! { div.radars { @for radar in radars { (one(radar)) } } "\n" })
}

/// Radars are placed in the overview of sensors.
pub(super) fn is_radar(figure: &Figure) -> bool {
    figure.id.starts_with("radar")
}
